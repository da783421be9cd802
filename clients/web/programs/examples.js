/** Programs to try at once: the files and the setup of clients/nc, which the service brings with its page. */

import { get } from '../api.js';
import { pageFile } from '../page_files.js';
import { writeFile, writeSetup } from './disk.js';

/** @type program, files and the setup of each, below clients/nc */
export const EXAMPLES = [
  { name: '8255', files: ['8255.h', '82551.h', '82552.a'], setup: 'hole-good' },
  { name: '8210', files: ['8210.h', '82101.tab'], setup: 'highest-in-the-middle' },
  { name: '8025', files: ['8025.h'], setup: 'cutter' },
  { name: '444', files: ['444.h'], setup: 'plate' },
  { name: '451', files: ['451.h', '4511.a', '4512.a'], setup: 'off-centre' },
];

const example = async (path) => (await get(pageFile(`examples/${path}`))).text();

/** What is there already stays as it is: somebody may have changed it. */
const unlessThere = (problem) => { if (problem.status !== 412) throw problem; };

/** Puts an example on the control's disk. @returns {path, setup} */
export async function bringExample({ name, files, setup }) {
  const none = { 'If-None-Match': '*' };
  for (const file of files) await writeFile(`nc_prog/${name}/${file}`, await example(`${name}/${file}`), none).catch(unlessThere);
  const setupName = `${name}-${setup}`;
  await writeSetup(setupName, await example(`${name}/setups/${setup}.json`), none).catch(unlessThere);
  return { path: `nc_prog/${name}/${files[0]}`, setup: setupName };
}
