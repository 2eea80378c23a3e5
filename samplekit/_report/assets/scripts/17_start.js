// Everything starts here, once the page is there.

for (const part of document.querySelectorAll(".scripted, #theme")) part.hidden = false;
buildTheme();
buildLegend();
buildCost();
for (const section of document.querySelectorAll(".scene")) new SceneCharts(section);
for (const host of document.querySelectorAll(".flips")) new Flips(host);
buildMetric();
buildTable();
for (const section of document.querySelectorAll("#compare")) new Comparison(section);
window.addEventListener("beforeprint", () => {
  for (const details of document.querySelectorAll("main details")) details.open = true;
});
document.documentElement.dataset.ready = "yes";
