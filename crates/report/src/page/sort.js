// Tables whose headings sort their rows; what is no number comes last.
"use strict";
for (const table of document.querySelectorAll("table.sortable")) {
  const body = table.tBodies[0];
  [...table.querySelectorAll("th")].forEach((heading, column) => {
    heading.addEventListener("click", () => {
      const sign = heading.dataset.down === "1" ? -1 : 1;
      heading.dataset.down = sign > 0 ? "1" : "0";
      const value = row => {
        const text = row.cells[column].textContent;
        return text === "" || text === "-" ? Infinity : isNaN(text) ? text : Number(text);
      };
      const rows = [...body.rows].map(row => [value(row), row]);
      rows.sort(([x], [y]) => (x < y ? -sign : x > y ? sign : 0));
      body.append(...rows.map(([, row]) => row));
    });
  });
}
