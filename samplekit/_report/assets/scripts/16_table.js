// The table of all rows: sorted by a click on a column's name, narrowed by words.

function buildTable() {
  const table = document.getElementById("rows");
  const body = table.tBodies[0];
  const headers = [...table.tHead.rows[0].cells];
  headers.forEach((header, column) => {
    const button = document.createElement("button");
    button.type = "button";
    button.append(...header.childNodes);
    header.append(button);
    button.addEventListener("click", () => {
      const rising = header.getAttribute("aria-sort") !== "ascending";
      for (const other of headers) other.removeAttribute("aria-sort");
      header.setAttribute("aria-sort", rising ? "ascending" : "descending");
      sortRows(body, column, rising);
    });
  });
  const search = document.getElementById("search");
  search.addEventListener("input", () => {
    const words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
    for (const row of body.rows) {
      const text = row.textContent.toLowerCase();
      row.hidden = !words.every((word) => text.includes(word));
    }
  });
}

// Cells without a value come last, whichever way.
function sortRows(body, column, rising) {
  const key = (row) => {
    const cell = row.cells[column];
    if (cell.dataset.value === undefined) return cell.textContent.trim();
    return cell.dataset.value === "" ? null : Number(cell.dataset.value);
  };
  const order = rising ? d3.ascending : d3.descending;
  const rows = [...body.rows].map((row) => ({ row, value: key(row) }));
  rows.sort((a, b) => (a.value === null) - (b.value === null) || order(a.value, b.value));
  body.append(...rows.map(({ row }) => row));
}
