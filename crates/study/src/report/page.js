"use strict";

// Tables whose heads sort: each title becomes a button; `aria-sort` says what is sorted, and how.
for (const table of document.querySelectorAll("table[data-sortable]")) {
  const heads = [...table.tHead.rows[0].cells];
  heads.forEach((head, column) => {
    const button = document.createElement("button");
    button.type = "button";
    button.append(...head.childNodes);
    head.append(button);
    button.addEventListener("click", () => {
      const down = head.getAttribute("aria-sort") === "ascending";
      for (const other of heads) other.removeAttribute("aria-sort");
      head.setAttribute("aria-sort", down ? "descending" : "ascending");
      sortRows(table.tBodies[0], column, down ? -1 : 1);
    });
  });
}

// Numbers by amount, words by their letters; cells without an amount stay last either way.
function sortRows(body, column, sign) {
  const isNumeric = [...body.rows].some((row) => row.cells[column].dataset.sort !== undefined);
  const key = (row) => {
    const cell = row.cells[column];
    if (!isNumeric) return cell.textContent;
    return cell.dataset.sort === undefined ? null : Number(cell.dataset.sort);
  };
  const compare = (a, b) => {
    if (a === null || b === null) return (a === null) - (b === null);
    return sign * (isNumeric ? a - b : a.localeCompare(b));
  };
  const rows = [...body.rows].map((row) => [key(row), row]);
  rows.sort(([a], [b]) => compare(a, b));
  body.append(...rows.map(([, row]) => row));
}

// Pictures one over the other: the slider says how much of the upper one is seen, and tells so in words.
for (const slider of document.querySelectorAll(".slider")) {
  const input = slider.querySelector("input");
  const [left, right] = [input.dataset.left, input.dataset.right];
  const show = () => {
    slider.style.setProperty("--cut", `${input.value}%`);
    input.setAttribute("aria-valuetext", `${input.value} % ${left}, ${100 - input.value} % ${right}`);
  };
  input.addEventListener("input", show);
  show();
}
