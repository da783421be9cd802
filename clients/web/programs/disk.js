/** The control's disk: paths, files, checks, setups. */

import { get, getJson, request, url } from '../api.js';
import { Decimal } from '../exact.js';

/** "TNC:\nc_prog\8255.h" and "nc_prog/8255.h" name the same file. */
export const relative = (path) => path.replace(/^TNC:\\?/i, '').replaceAll('\\', '/');
export const onControl = (path) => `TNC:\\${relative(path).replaceAll('/', '\\')}`;
export const fileName = (path) => path.slice(Math.max(path.lastIndexOf('\\'), path.lastIndexOf('/')) + 1);
export const isProgram = (path) => /\.[hi]$/i.test(path);

const fileUrl = (path, options) => url(['files', ...relative(path).split('/')], options);

export const listFiles = async () => (await getJson(url(['files']))).files.map((file) => ({ ...file, path: relative(file.path) }));
/** The text of a file as {text, tag, size, reason}: `reason` says why it is only shown, or not even that. */
export async function readFile(path) {
  const response = await get(fileUrl(path));
  const bytes = await response.arrayBuffer();
  const file = { tag: response.headers.get('ETag'), size: bytes.byteLength };
  try {
    const text = new TextDecoder('utf-8', { fatal: true, ignoreBOM: true }).decode(bytes);
    return text.includes('\0') ? { ...file, text: null, reason: 'no_text' } : { ...file, text };
  } catch {
    const text = new TextDecoder('windows-1252').decode(bytes);
    return text.includes('\0') ? { ...file, text: null, reason: 'no_text' } : { ...file, text, reason: 'not_utf8' };
  }
}

const CALL = /CALL\s+PGM\s+"?([^\s";]+)/gi;
const MOST_CALLED = 8;
/** The texts of the programs that a text calls by their names; what is not there has none. */
export async function calledTexts(path, text) {
  const folder = path.slice(0, path.lastIndexOf('/') + 1);
  const names = [...new Set([...text.matchAll(CALL)].map(([, name]) => (/[\\/:]/.test(name) ? relative(name) : folder + name)))].slice(0, MOST_CALLED);
  const read = await Promise.all(names.map((name) => readFile(/\.\w+$/.test(name) ? name : `${name}.h`).catch(() => null)));
  return read.map((file) => file?.text).filter(Boolean);
}

/** @param conditions headers such as If-Match. @returns the tag of what is stored now */
export async function writeFile(path, bytes, conditions = {}) {
  return (await request('PUT', fileUrl(path), { body: bytes, headers: conditions })).headers.get('ETag');
}

export const removeFile = (path) => request('DELETE', fileUrl(path));

/** What is wrong with a text that would stand at a path. */
export async function check(path, text, signal) {
  return (await (await request('POST', fileUrl(path, { action: 'check' }), { body: text, signal })).json()).diagnostics;
}

/** The newest runs of a program. */
export const listRuns = async (path, limit) => (await getJson(url(['runs'], { program: onControl(path), limit }))).runs;

export const listSetups = async () => (await getJson(url(['setups']))).setups.map((setup) => setup.name);
export const readSetup = async (name) => (await get(url(['setups', name]))).text();
export const writeSetup = (name, text, conditions = {}) =>
  request('PUT', url(['setups', name]), { body: text, headers: { 'Content-Type': 'application/json', ...conditions } });

/** Lines of `Q1 = 25` and `QS1 = "H7"` as the parameters of a run. @throws Error naming the line */
export function readParameters(text, complain) {
  const lines = text.split('\n').filter((line) => line.trim());
  return Object.fromEntries(lines.map((line) => {
    const match = /^\s*(Q[LRS]?\d+)\s*=\s*(.*?)\s*$/i.exec(line);
    const name = match?.[1].toUpperCase();
    const number = match && !name.startsWith('QS') && /^[+-]?\d+([.,]\d+)?$/.test(match[2]);
    if (!match || (!number && !name.startsWith('QS'))) throw new Error(complain(line.trim()));
    const value = number ? new Decimal(match[2].replace(',', '.').replace(/^\+/, '').replace(/^(-?)0+(?=\d)/, '$1')) : match[2].replace(/^"(.*)"$/, '$1');
    return [name, value];
  }));
}
