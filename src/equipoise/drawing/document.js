// Draws the charts one after the other, so that the page stays alive; without the chart library the pictures stay.
(function () {
  if (!window.Plotly) return;
  document.body.classList.remove("no-charts");
  const draw = (element) => {
    const chart = JSON.parse(document.getElementById(element.dataset.chart).textContent);
    const quiet = { gridcolor: "#e4e7eb", linecolor: "#57606a", ticks: "outside", tickcolor: "#57606a" };
    Object.assign(chart.layout.xaxis, quiet);
    Object.assign(chart.layout.yaxis, quiet);
    chart.layout.font = { family: "system-ui, DejaVu Sans, sans-serif", size: 12, color: "#1b1f24" };
    Plotly.newPlot(element, chart.data, chart.layout, { responsive: true, displayModeBar: false });
  };
  const waiting = Array.from(document.querySelectorAll(".chart"));
  const next = () => {
    const element = waiting.shift();
    if (!element) return;
    draw(element);
    setTimeout(next, 0);
  };
  next();
})();
