// The box beside the point under the pointer; a screen reader hears it as well.

const TOOLTIP = document.getElementById("tooltip");

function showTooltip({ title, facts, remarks }, { x, y }) {
  const heading = document.createElement("strong");
  heading.textContent = title;
  const list = document.createElement("dl");
  for (const [name, value] of facts) {
    list.append(Object.assign(document.createElement("dt"), { textContent: name }));
    list.append(Object.assign(document.createElement("dd"), { textContent: value }));
  }
  const notes = remarks.map((remark) =>
    Object.assign(document.createElement("div"), { className: "soft", textContent: remark }),
  );
  TOOLTIP.replaceChildren(heading, list, ...notes);
  TOOLTIP.hidden = false;
  const box = TOOLTIP.getBoundingClientRect();
  const width = document.documentElement.clientWidth;
  const left = x + 18 + box.width > width ? x - 18 - box.width : x + 18;
  const top = Math.min(y - 12, window.innerHeight - box.height - 8);
  TOOLTIP.style.left = `${window.scrollX + Math.max(8, Math.min(left, width - box.width - 8))}px`;
  TOOLTIP.style.top = `${window.scrollY + Math.max(8, top)}px`;
}

function hideTooltip() {
  TOOLTIP.hidden = true;
}
