/** NC programs: put them on the control's disk, check them, run them, see what they did. */

import { confirm } from '../confirm.js';
import { h } from '../dom.js';
import { explain, t } from '../i18n.js';
import { check, fileName, isProgram, listFiles, readText, removeFile, writeFile } from '../programs/disk.js';
import { FileList } from '../programs/file_list.js';
import { RunForm } from '../programs/run_form.js';
import { sourceText } from '../programs/source.js';
import { go } from '../route.js';

export function mount(main, route) {
  let current = route.path.join('/');
  let text = '';
  const files = new FileList({ onPick: (path) => pick(path), onUpload: upload });
  const form = new RunForm({ onDiagnostics: show, onRun: (run, setup) => remember({ run, setup }), onMove: showLine });
  const title = h('h2.title');
  const note = h('p.note', { role: 'status' });
  const source = h('div.listing');
  const actions = h('p.actions',
    h('button', { type: 'button', onclick: () => attempt(checkCurrent) }, t('programs.check')),
    h('button', { type: 'button', onclick: () => attempt(remove) }, t('programs.delete')));
  const program = h('div.program', h('div.line', title, actions), source, form.element);
  const nothing = h('p.empty', t('programs.pick'));

  main.replaceChildren(h('div.desk.programs', h('h1.unseen', { tabindex: -1 }, t('view.programs')), files.element, h('div.program', note, nothing, program)));

  function remember(options = {}) {
    go({ view: 'programs', path: current.split('/').filter(Boolean), options }, { refine: true });
  }

  async function attempt(action) {
    note.textContent = '';
    try {
      await action();
    } catch (problem) {
      note.textContent = explain(problem);
    }
  }

  function show(diagnostics) {
    source.replaceChildren(...sourceText(current, text, diagnostics, (line) => form.toLine(line)));
  }

  /** The line of a move, where it is one of the program that is open. */
  function showLine({ program: where, line }) {
    source.querySelector('.here')?.classList.remove('here');
    const [row] = fileName(where).toLowerCase() === fileName(current).toLowerCase() ? source.querySelectorAll(`.source li:nth-child(${line})`) : [];
    row?.classList.add('here');
    row?.scrollIntoView({ block: 'nearest' });
  }

  async function list() {
    const all = await listFiles();
    files.show(all, current);
    return all;
  }

  async function open(options = {}) {
    nothing.hidden = current !== '';
    program.hidden = current === '';
    if (!current) return;
    title.textContent = fileName(current);
    text = await readText(current);
    show([]);
    form.element.hidden = !isProgram(current);
    if (!isProgram(current)) return;
    await form.show(current, options.setup);
    if (options.run) await form.showRun(options.run);
  }

  const pick = (path) => attempt(async () => {
    current = path;
    form.report.replaceChildren();
    remember();
    await list();
    await open();
  });

  const checkCurrent = async () => {
    const diagnostics = await check(current);
    show(diagnostics);
    const errors = diagnostics.filter((each) => each.severity === 'error').length;
    note.textContent = diagnostics.length ? t('programs.found', { errors, warnings: diagnostics.length - errors }) : t('programs.in_order');
  };

  const remove = async () => {
    if (!await confirm(t('programs.delete_sure', { name: current }), t('programs.delete'))) return;
    await removeFile(current);
    current = '';
    remember();
    await list();
    await open();
  };

  function upload(folder, chosen) {
    return attempt(async () => {
      const there = new Set((await listFiles()).map(({ path }) => path.toLowerCase()));
      const replaced = chosen.map((file) => file.name).filter((name) => there.has([folder, name].filter(Boolean).join('/').toLowerCase()));
      if (replaced.length && !await confirm(t('programs.replace_sure', { names: replaced.join(', ') }), t('programs.replace'))) return;
      for (const file of chosen) await writeFile([folder, file.name].filter(Boolean).join('/'), await file.arrayBuffer());
      const first = chosen.find((file) => isProgram(file.name)) ?? chosen[0];
      await pick([folder, first.name].filter(Boolean).join('/'));
    });
  }

  attempt(async () => {
    await list();
    await open(route.options);
  });
}
