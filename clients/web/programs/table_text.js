/** Tables of the control (.tab, .t, .tp, .pr, .d): their text as cells. A cell that is changed changes its place in the text alone. */

const HEAD = /^\s*BEGIN\s/i;
const END = /^\s*\[END\]\s*$/i;
const MOST_CELLS = 4000;
const LEAST_WIDTH = 1;

export const isTable = (path) => /\.(tab|t|tp|pr|d|pnt)$/i.test(path);

/**
 * {columns: [{name, begin, width}], rows: [{line, cells}], fixed} of a text; `fixed` where a description sets the widths. null where it
 * is no such table, a cell reaches over the beginning of a column, or there are too many cells.
 */
export function readTable(text, mostCells = MOST_CELLS) {
  const lines = text.split('\n');
  let at = lines.findIndex((line) => HEAD.test(line));
  if (at < 0 || text.includes('\t')) return null;
  const isFixed = lines.some((line) => /^\s*#STRUCTBEGIN/i.test(line));
  at = isFixed ? lines.findIndex((line) => /^\s*#STRUCTEND/i.test(line)) : at;
  do ++at; while (at < lines.length && (/^\s*;/.test(lines[at]) || !lines[at].trim()));
  if (at >= lines.length) return null;
  const names = [...lines[at].matchAll(/\S+/g)];
  const columns = names.map(({ 0: name, index: begin }, i) => ({ name, begin, width: i + 1 < names.length ? names[i + 1].index - begin - 1 : Infinity }));
  const rows = [];
  for (let line = at + 1; line < lines.length && !END.test(lines[line]); ++line) {
    const row = lines[line];
    if (!row.trim() || /^\s*;/.test(row)) continue;
    if (columns.some(({ begin }) => begin > 0 && /\S\S/.test(row.slice(begin - 1, begin + 1)))) return null;
    rows.push({ line, cells: columns.map(({ begin }, i) => row.slice(begin, columns[i + 1]?.begin).trim()) });
  }
  return rows.length * columns.length > mostCells ? null : { columns, rows, fixed: isFixed, head: at };
}

/** The text with another value in a cell. @throws RangeError with the width where it does not fit and a description sets it */
export function withCell(text, table, row, column, value) {
  const { begin, width } = table.columns[column];
  const lines = text.split('\n');
  if (value.length > width && table.fixed) throw new RangeError(String(width));
  const more = Math.max(value.length - width, 0);
  if (more && Number.isFinite(width)) {
    const next = table.columns[column + 1].begin;
    for (const line of [table.head, ...table.rows.map((one) => one.line)]) {
      if (lines[line].length > next) lines[line] = lines[line].slice(0, next) + ' '.repeat(more) + lines[line].slice(next);
    }
  }
  const { line } = table.rows[row];
  const old = lines[line].padEnd(begin);
  const end = Number.isFinite(width) ? begin + Math.max(width, LEAST_WIDTH) + more : old.length;
  lines[line] = (old.slice(0, begin) + (Number.isFinite(width) ? value.padEnd(end - begin) : value) + old.slice(end)).trimEnd();
  return lines.join('\n');
}

/** With another row at the end, its number one more than that of the last. */
export function withRow(text, table) {
  const lines = text.split('\n');
  const last = table.rows.at(-1);
  const next = last ? Math.trunc(Number(last.cells[0])) + 1 : 0;
  lines.splice((last?.line ?? table.head) + 1, 0, ' '.repeat(table.columns[0].begin) + String(Number.isFinite(next) ? next : ''));
  return lines.join('\n');
}

export function withoutRow(text, table, row) {
  const lines = text.split('\n');
  lines.splice(table.rows[row].line, 1);
  return lines.join('\n');
}
