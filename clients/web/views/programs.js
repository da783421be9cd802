/** NC programs: put them on the control's disk, check them, run them, see what they did. */

import { getJson, url } from '../api.js';
import { confirm } from '../confirm.js';
import { mayReplace } from '../documents.js';
import { h } from '../dom.js';
import { explain, t } from '../i18n.js';
import { fileName, isProgram, listFiles, relative, removeFile, writeFile } from '../programs/disk.js';
import { bringExample, EXAMPLES } from '../programs/examples.js';
import { FileList } from '../programs/file_list.js';
import { ProgramText } from '../programs/program_text.js';
import { RunForm } from '../programs/run_form.js';
import { go } from '../route.js';

export function mount(main, route) {
  let current = route.path.join('/');
  const leaving = new AbortController();
  const files = new FileList({ onPick: (path) => pick(path), onUpload: upload, onBegin: begin });
  const source = new ProgramText({
    leaving: leaving.signal, onLine: (line, called) => form.toLine(line, called), onState: showState, onStore: () => attempt(store),
  });
  const form = new RunForm({
    onDiagnostics: (found) => source.show(found), onRun: (run, setup) => remember({ run, setup }),
    onMove: ({ program: where, line }) => source.showLine(where, line), beforeRun: store, textOf: () => source.editor.text,
  });
  addEventListener('breaks', () => [source, form].forEach((each) => each.showBreaks()), { signal: leaving.signal });
  const name = h('span');
  const state = h('span.aside', { role: 'status' });
  const title = h('h2.title', name, state);
  const note = h('p.note', { role: 'status' });
  const storing = h('button.primary', { type: 'button', onclick: () => attempt(store) }, t('programs.store'));
  const dropping = h('button', { type: 'button', onclick: () => attempt(drop) }, t('document.drop'));
  const actions = h('p.actions', storing, dropping,
    h('button', { type: 'button', onclick: () => attempt(checkCurrent) }, t('programs.check')),
    h('button', { type: 'button', onclick: () => attempt(remove) }, t('programs.delete')));
  const heading = h('div.line', title, actions);
  const program = h('div.program', heading, form.element, h('div.bench', source.element, form.report));
  const examples = h('p.actions', EXAMPLES.map((one) => h('button', { type: 'button', onclick: () => attempt(() => tryOut(one)) },
    h('strong', one.name), h('span.aside', t(`example.${one.name}`)))));
  const nothing = h('section.empty', h('p', t('programs.pick')), h('h2', t('example.title')), h('p', t('example.how')), examples);

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

  function showState() {
    state.textContent = source.dirty ? t('programs.not_stored') : '';
    storing.disabled = !source.dirty;
    note.textContent = ''; // what was said was said of another text
    dropping.hidden = !source.dirty;
  }

  async function store() {
    if (!source.dirty) return;
    const isNew = source.tag === null;
    await source.store();
    if (isNew) await list();
  }

  async function drop() {
    if (!await confirm(t('programs.drop_sure', { name: fileName(current) }), t('document.drop'))) return;
    const isNew = source.tag === null;
    ProgramText.forget(current);
    if (isNew) current = '';
    await list();
    await open();
  }

  async function list() {
    const there = await listFiles();
    const elsewhere = ProgramText.unstored.filter((path) => there.every((file) => file.path !== path));
    files.show([...there, ...elsewhere.map((path) => ({ path }))], current);
  }

  async function open(options = {}) {
    if (current) heading.after(note);
    else nothing.before(note);
    nothing.hidden = current !== '';
    program.hidden = current === '';
    if (!current) return;
    const asked = current;
    try {
      if (!await source.open(asked)) return;
    } catch (problem) {
      if (current !== asked) return;
      current = ''; // what was open before does not stand under the name of this one
      await open();
      throw problem;
    }
    name.textContent = fileName(current);
    form.element.hidden = !isProgram(current);
    form.report.hidden = !isProgram(current);
    if (!isProgram(current)) return;
    await form.show(current, options.setup);
    if (options.run) await form.showRun(options.run);
  }

  const pick = (path) => attempt(async () => {
    current = path;
    form.open(path);
    remember();
    await list();
    await open();
  });

  const checkCurrent = async () => {
    const diagnostics = await source.check();
    if (!diagnostics) return;
    const errors = diagnostics.filter((each) => each.severity === 'error').length;
    note.textContent = diagnostics.length ? t('programs.found', { errors, warnings: diagnostics.length - errors }) : t('programs.in_order');
  };

  const remove = async () => {
    if (!await confirm(t('programs.delete_sure', { name: current }), t('programs.delete'))) return;
    if (source.tag !== null) await removeFile(current);
    ProgramText.forget(current);
    current = '';
    remember();
    await list();
    await open();
  };

  /** Brings an example, opens it and runs it. */
  async function tryOut(one) {
    const { path, setup } = await bringExample(one);
    current = path;
    form.open(path);
    remember({ setup });
    await list();
    await open({ setup });
    await form.run();
  }

  function begin(path) {
    const stem = fileName(path).replace(/\.[^.]*$/, '');
    ProgramText.begin(path, `BEGIN PGM ${stem} MM\nEND PGM ${stem} MM\n`);
    return pick(path);
  }

  function upload(folder, chosen) {
    return attempt(async () => {
      const there = new Set((await listFiles()).map(({ path }) => path.toLowerCase()));
      const replaced = chosen.map((file) => file.name).filter((name) => there.has([folder, name].filter(Boolean).join('/').toLowerCase()));
      if (replaced.length && !await mayReplace(replaced)) return;
      for (const file of chosen) {
        const path = [folder, file.name].filter(Boolean).join('/');
        await writeFile(path, await file.arrayBuffer());
        ProgramText.forget(path);
      }
      const first = chosen.find((file) => isProgram(file.name)) ?? chosen[0];
      await pick([folder, first.name].filter(Boolean).join('/'));
    });
  }

  attempt(async () => {
    const { run } = route.options;
    // Where only the run is known, it knows its program.
    if (run && !current) current = relative((await getJson(url(['runs', run]))).program);
    await list();
    await open(route.options);
  });
  return () => {
    leaving.abort();
    form.leave();
  };
}
