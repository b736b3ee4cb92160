// Appended to a report: writes into the page what is wrong with how it stands there.
(() => {
  // Values under the pointer, a zoom by dragging, and all of it again.
  function drive(box) {
    SVGElement.prototype.setPointerCapture = () => {}; // there is no real pointer
    const point = (kind, part) => {
      const svg = box.querySelector("svg"), area = svg.getBoundingClientRect();
      const at = {clientX: area.left + part * area.width, clientY: area.top + area.height / 2, bubbles: true};
      svg.dispatchEvent(new PointerEvent(kind, at));
    };
    const axis = () => Array.from(box.querySelectorAll("svg > text[text-anchor=middle]")).map(t => t.textContent).join(" ");
    const whole = axis(), tip = document.getElementById("tip");
    point("pointermove", 0.5);
    if (tip.hidden || !/\n.*\d/.test(tip.textContent)) fault("no values under the pointer");
    point("pointerleave", 0.5);
    if (!tip.hidden) fault("values stay when the pointer has left");
    for (const [kind, part] of [["pointerdown", 0.4], ["pointermove", 0.6], ["pointerup", 0.6]]) point(kind, part);
    if (axis() === whole) fault("dragging does not zoom");
    point("dblclick", 0.5);
    if (axis() !== whole) fault("a double click does not show all of it");
  }
  // Rows in the order of a column of numbers, and in the other order by a second click.
  function sort(table, column) {
    const numbers = () => Array.from(table.tBodies[0].rows).map(row => Number(row.cells[column].dataset.key ?? row.cells[column].textContent));
    const head = table.querySelectorAll("thead th")[column];
    for (const [order, text] of [[(a, b) => a - b, "ascending"], [(a, b) => b - a, "descending"]]) {
      head.querySelector("button").click();
      if (String(numbers()) !== String(numbers().sort(order))) fault(`rows are not sorted ${text}`);
      if (head.getAttribute("aria-sort") !== text) fault(`aria-sort is not ${text}`);
    }
  }
  // Only rows with all words stay, and all come back.
  function filter(table) {
    const field = table.closest(".card").querySelector(".filter input");
    const type = text => { field.value = text; field.dispatchEvent(new Event("input")); };
    const before = table.rows.length, word = table.tBodies[0].rows[0].cells[0].textContent;
    type("no-such-word");
    if (table.tBodies[0].rows.length) fault("rows without the word stay");
    type(word);
    if (!table.tBodies[0].rows.length) fault("rows with the word go");
    type("");
    if (table.rows.length < Math.min(before, 100)) fault("rows do not come back");
  }
  // As a printer lays the page out: nothing wider than the paper.
  function print() {
    for (const sheet of document.styleSheets)
      for (const rule of sheet.cssRules) if (rule.media?.mediaText === "print") rule.media.mediaText = "all";
    const main = document.querySelector("main");
    main.style.width = main.classList.contains("wide") ? "1047px" : "703px"; // A4 less its margins
    for (const table of document.querySelectorAll("table"))
      if (table.offsetWidth > main.offsetWidth + 1) fault(`a printed table is ${table.offsetWidth} px wide`);
  }
  const faults = [];
  const fault = text => { if (faults.length < 20) faults.push(text); };
  const root = document.documentElement, narrow = root.clientWidth < 800;
  if (narrow) root.style.width = "390px"; // windows are not made narrower than 500
  for (const name of ["beforeprint", "afterprint"]) dispatchEvent(new Event(name)); // draws all plots
  const wide = narrow ? 390 : root.clientWidth;
  if (document.body.scrollWidth > wide) fault(`page is ${document.body.scrollWidth} px wide in ${wide}`);
  for (const element of document.querySelectorAll("body *")) {
    const text = Array.from(element.childNodes).some(n => n.nodeType === 3 && n.textContent.trim());
    if (!text || element.closest("script, style, [hidden]")) continue;
    const size = parseFloat(getComputedStyle(element).fontSize);
    if (size < 11) fault(`text of ${size} px: ${element.textContent.trim().slice(0, 30)}`);
  }
  for (const card of document.querySelectorAll(".card"))
    for (const inside of card.querySelectorAll("svg, img, figure, h3, dl")) {
      if (inside.closest(".scroll")) continue;
      const a = card.getBoundingClientRect(), b = inside.getBoundingClientRect();
      if (b.left < a.left - 1 || b.right > a.right + 1) fault(`${inside.tagName} leaves its card`);
    }
  for (const table of document.querySelectorAll(".scroll"))
    if (!narrow && table.scrollWidth > table.clientWidth + 1) fault(`a table is cut: ${table.scrollWidth} px in ${table.clientWidth}`);
  for (const cell of document.querySelectorAll("th, td"))
    if (cell.textContent.trim().length > 5 && cell.clientWidth < 36) fault(`a cell of ${cell.clientWidth} px: ${cell.textContent.slice(0, 30)}`);
  for (const head of document.querySelectorAll("table.sortable th"))
    if (!head.querySelector("button")) fault("a head is no button");
  for (const text of document.querySelectorAll("h3, figcaption, dd, dt"))
    if (text.scrollWidth > text.clientWidth + 1) fault(`text leaves its box: ${text.textContent.slice(0, 30)}`);
  const plots = document.querySelectorAll(".plot svg");
  for (const svg of plots) {
    const whole = svg.getBoundingClientRect();
    if (!svg.getAttribute("aria-label") || !document.getElementById(svg.getAttribute("aria-describedby"))?.textContent)
      fault("a plot has no name or description");
    if (whole.width < 200) fault(`a plot is ${whole.width} px wide`);
    const boxes = Array.from(svg.querySelectorAll("text")).map(t => [t.textContent, t.getBoundingClientRect()]);
    boxes.forEach(([text, box], i) => {
      if (box.left < whole.left - 1 || box.right > whole.right + 1 || box.top < whole.top - 1 || box.bottom > whole.bottom + 1)
        fault(`text is cut: ${text}`);
      for (const [other, second] of boxes.slice(i + 1))
        if (box.left < second.right - 1 && second.left < box.right - 1 && box.top < second.bottom - 2 && second.top < box.bottom - 2)
          fault(`texts overlap: ${text} | ${other}`);
    });
  }
  for (const box of document.querySelectorAll(".plot[data-height]"))
    if (!box.plot.log && box.querySelectorAll("svg > text[text-anchor=end]:not(.soft)").length < 2)
      fault(`one number alone at an axis: ${box.querySelector("h3").textContent}`);
  if (document.querySelectorAll(".plot[data-height]").length !== plots.length) fault("plots are missing");
  const box = Array.from(document.querySelectorAll(".plot[data-height]")).find(b => !b.classList.contains("small"));
  if (box) drive(box);
  const runs = document.querySelector("table.runs");
  if (runs && runs.rows.length > 21) filter(runs);
  if (runs) sort(runs, Array.from(runs.querySelectorAll("thead th")).findIndex(head => head.textContent.startsWith("Longest")));
  const rows = document.querySelectorAll("tr").length;
  if (rows > 2500) fault(`${rows} rows are made at once`);
  print();
  const pre = document.createElement("pre");
  pre.id = "verdict";
  pre.textContent = `PLOTS ${plots.length} FAULTS ${faults.length}\n${faults.join("\n")}\nEND`;
  document.body.appendChild(pre);
})();
