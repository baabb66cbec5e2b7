// Values of every named series under the pointer. The curves are read from the paths themselves; data-plot maps px to values.
"use strict";
for (const svg of document.querySelectorAll("svg[data-plot]")) {
  const [left, top, width, height, xLow, xHigh, yLow, yHigh] = svg.dataset.plot.split(" ").map(Number);
  const curves = [...svg.querySelectorAll("[data-series]")].map(path => ({
    name: path.dataset.series,
    strokes: path.getAttribute("d").split("M").slice(1).map(s => s.split("L").map(p => p.split(" ").map(Number)))
  }));
  const at = (curve, x) => {
    for (const stroke of curve.strokes)
      for (let i = 1; i < stroke.length; i++) {
        const [a, b] = [stroke[i - 1], stroke[i]];
        if ((a[0] - x) * (b[0] - x) <= 0 && a[0] !== b[0]) return a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0]);
      }
    return NaN;
  };
  const shown = (v, unit) => String(Number(v.toPrecision(4))).replace("-", "\u2212") + (unit && unit !== "°" ? " " : "") + unit;
  const box = document.createElement("div"), cursor = document.createElementNS(svg.namespaceURI, "path");
  box.className = "readout"; box.hidden = true;
  cursor.setAttribute("class", "cursor");
  svg.append(cursor); svg.parentNode.append(box);
  const hide = () => { box.hidden = true; cursor.setAttribute("d", ""); };
  const show = event => {
    const frame = svg.getBoundingClientRect(), scale = svg.viewBox.baseVal.width / frame.width;
    const x = (event.clientX - frame.left) * scale, y = (event.clientY - frame.top) * scale;
    if (x < left || x > left + width || y < top - 10 || y > top + height + 10) return hide();
    cursor.setAttribute("d", `M${x} ${top}V${top + height}`);
    box.replaceChildren();
    const line = words => { const row = document.createElement("div"); row.textContent = words; box.append(row); };
    line(shown(xLow + (x - left) / width * (xHigh - xLow), svg.dataset.x));
    for (const curve of curves) {
      const py = at(curve, x);
      if (!Number.isNaN(py)) line(curve.name + ": " + shown(yHigh - (py - top) / height * (yHigh - yLow), svg.dataset.y));
    }
    box.hidden = false;
    const place = x / scale + 14;
    box.style.left = (place + box.offsetWidth > frame.width ? place - box.offsetWidth - 28 : place) + "px";
    box.style.top = top / scale + 6 + "px";
  };
  svg.addEventListener("pointermove", show);
  svg.addEventListener("pointerdown", show);
  svg.addEventListener("pointerleave", hide);
}
