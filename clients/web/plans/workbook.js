/** The first sheet of an XLSX workbook as rows of texts (ECMA-376): a ZIP archive of XML files. */

import { t } from '../i18n.js';

const [END, ENTRY] = [0x06054b50, 0x02014b50];
const DEFLATED = 8;
/** Of one file of the workbook, unpacked. */
const LARGEST_BYTES = 64 << 20;

const broken = () => new Error(t('file.no_workbook'));

/** The files of an archive by name, each to be unpacked: () => text. */
function entriesOf(bytes) {
  const view = new DataView(bytes);
  let end = bytes.byteLength - 22;
  while (end >= 0 && view.getUint32(end, true) !== END) --end;
  if (end < 0) throw broken();
  const found = new Map();
  let at = view.getUint32(end + 16, true);
  for (let left = view.getUint16(end + 10, true); left > 0; --left) {
    if (view.getUint32(at, true) !== ENTRY) throw broken();
    const [method, packed, size] = [view.getUint16(at + 10, true), view.getUint32(at + 20, true), view.getUint32(at + 24, true)];
    const [nameLength, extra, comment] = [28, 30, 32].map((place) => view.getUint16(at + place, true));
    const start = view.getUint32(at + 42, true);
    const name = new TextDecoder().decode(new Uint8Array(bytes, at + 46, nameLength));
    const data = start + 30 + view.getUint16(start + 26, true) + view.getUint16(start + 28, true);
    found.set(name, () => unpacked(new Blob([bytes.slice(data, data + packed)]), method, size));
    at += 46 + nameLength + extra + comment;
  }
  return found;
}

async function unpacked(blob, method, size) {
  if (size > LARGEST_BYTES) throw broken();
  if (method !== DEFLATED) return blob.text();
  if (!globalThis.DecompressionStream) throw new Error(t('file.old_browser'));
  return new Response(blob.stream().pipeThrough(new DecompressionStream('deflate-raw'))).text();
}

const xml = (text) => new DOMParser().parseFromString(text, 'application/xml');
const all = (node, name) => [...node.getElementsByTagNameNS('*', name)];
const textOf = (node) => all(node, 't').map((each) => each.textContent).join('');
/** BC of BC12 is column 54. */
const columnOf = (place) => [...place.replace(/\d+$/, '')].reduce((sum, letter) => sum * 26 + letter.charCodeAt(0) - 64, 0) - 1;
/** What a program has computed stands there with all its digits. */
const numberOf = (text) => (text !== '' && Number.isFinite(Number(text)) ? String(Number(Number(text).toPrecision(12))) : text);

function valueOf(cell, shared) {
  const value = all(cell, 'v')[0]?.textContent ?? '';
  const type = cell.getAttribute('t');
  if (type === 's') return shared[Number(value)] ?? '';
  if (type === 'inlineStr') return textOf(cell);
  return type === 'str' ? value : numberOf(value);
}

/** @throws Error that says why it is none */
export async function rowsOfWorkbook(bytes) {
  const files = entriesOf(bytes);
  const read = async (name) => xml(await (files.get(name)?.() ?? ''));
  const first = all(await read('xl/workbook.xml'), 'sheet')[0];
  if (!first) throw broken();
  const id = first.getAttributeNS('http://schemas.openxmlformats.org/officeDocument/2006/relationships', 'id');
  const target = all(await read('xl/_rels/workbook.xml.rels'), 'Relationship').find((each) => each.getAttribute('Id') === id)?.getAttribute('Target');
  const shared = all(await read('xl/sharedStrings.xml'), 'si').map(textOf);
  const sheet = await read(target?.startsWith('/') ? target.slice(1) : `xl/${target}`);
  return all(sheet, 'row').map((row) => {
    const cells = [];
    for (const cell of all(row, 'c')) cells[columnOf(cell.getAttribute('r') ?? '')] = valueOf(cell, shared).trim();
    return Array.from(cells, (each) => each ?? '');
  }).filter((row) => row.some(Boolean));
}
