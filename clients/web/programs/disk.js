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
export const readText = async (path) => (await get(fileUrl(path))).text();
export const writeFile = (path, bytes) => request('PUT', fileUrl(path), { body: bytes });
export const removeFile = (path) => request('DELETE', fileUrl(path));

export async function check(path) {
  return (await (await request('POST', fileUrl(path, { action: 'check' }))).json()).diagnostics;
}

/** The newest runs of a program. */
export const listRuns = async (path, limit) => (await getJson(url(['runs'], { program: onControl(path), limit }))).runs;

export const listSetups = async () => (await getJson(url(['setups']))).setups.map((setup) => setup.name);
export const readSetup = async (name) => (await get(url(['setups', name]))).text();
export const writeSetup = (name, text) =>
  request('PUT', url(['setups', name]), { body: text, headers: { 'Content-Type': 'application/json' } });

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
