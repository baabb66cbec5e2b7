// Shows the values of every named series under the pointer. The curves are read from the paths themselves. data-plot has the
// frame of the plot in px (left, top, width, height) and the values at its borders (x low, x high, y low, y high).
"use strict";
for (const svg of document.querySelectorAll("svg[data-plot]")) {
  const [left, top, width, height, xLow, xHigh, yLow, yHigh] = svg.dataset.plot.split(" ").map(Number);
  const curves = [...svg.querySelectorAll("[data-series]")].map(path => ({
    name: path.dataset.series,
    polylines: path.getAttribute("d").split("M").slice(1).map(s => s.split("L").map(p => p.split(" ").map(Number)))
  }));
  // Height of a curve at x, both in px. NaN beside the curve.
  const y_at = (curve, x) => {
    for (const points of curve.polylines)
      for (let i = 1; i < points.length; i++) {
        const [a, b] = [points[i - 1], points[i]];
        if ((a[0] - x) * (b[0] - x) <= 0 && a[0] !== b[0]) return a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0]);
      }
    return NaN;
  };
  const number_text = (v, unit) => String(Number(v.toPrecision(4))).replace("-", "\u2212") + (unit && unit !== "°" ? " " : "") + unit;
  const box = document.createElement("div"), cursor = document.createElementNS(svg.namespaceURI, "path");
  box.className = "readout"; box.hidden = true;
  cursor.setAttribute("class", "cursor");
  svg.append(cursor); svg.parentNode.append(box);
  const hide = () => { box.hidden = true; cursor.setAttribute("d", ""); };
  const show = event => {
    const frame = svg.getBoundingClientRect(), scale = svg.viewBox.baseVal.width / frame.width;  // px of the figure per px of the window
    const x = (event.clientX - frame.left) * scale, y = (event.clientY - frame.top) * scale;
    if (x < left || x > left + width || y < top - 10 || y > top + height + 10) return hide();
    cursor.setAttribute("d", `M${x} ${top}V${top + height}`);
    box.replaceChildren();
    const add_line = text => { const row = document.createElement("div"); row.textContent = text; box.append(row); };
    add_line(number_text(xLow + (x - left) / width * (xHigh - xLow), svg.dataset.x));
    for (const curve of curves) {
      const curve_y = y_at(curve, x);
      if (!Number.isNaN(curve_y)) add_line(curve.name + ": " + number_text(yHigh - (curve_y - top) / height * (yHigh - yLow), svg.dataset.y));
    }
    box.hidden = false;
    // 14 px to the right of the pointer, or to its left where the window ends.
    const right_of_pointer = x / scale + 14;
    box.style.left = (right_of_pointer + box.offsetWidth > frame.width ? right_of_pointer - box.offsetWidth - 28 : right_of_pointer) + "px";
    box.style.top = top / scale + 6 + "px";
  };
  svg.addEventListener("pointermove", show);
  svg.addEventListener("pointerdown", show);
  svg.addEventListener("pointerleave", hide);
}
