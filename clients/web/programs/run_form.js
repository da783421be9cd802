/** A run: the setup it runs on, the parameters set before it, and how it goes. */

import { request, url } from '../api.js';
import { writeOrAsk } from '../documents.js';
import { field, h, refill } from '../dom.js';
import { readEvents } from '../events.js';
import { toJson } from '../exact.js';
import { dateTime, explain, t } from '../i18n.js';
import { calledTexts, listRuns, listSetups, onControl, readParameters, readSetup, writeSetup } from './disk.js';
import { runReport, screenOf } from './run_report.js';
import { parametersIn } from './steps.js';
import { WorkpieceForm } from './workpiece_form.js';

/** So many earlier runs of a program are offered. */
const MOST_RUNS = 10;

export class RunForm {
  /**
   * @param onDiagnostics takes what a refused program has wrong; @param onRun the id of a run; @param onMove the move that is shown
   * @param beforeRun stores what is to be run; @param textOf gives the text of the program that is open
   */
  constructor({ onDiagnostics, onRun, onMove, beforeRun, textOf }) {
    this.textOf = textOf;
    this.onMove = onMove;
    this.beforeRun = beforeRun;
    this.earlier = h('nav.earlier', { 'aria-label': t('programs.earlier') });
    this.onDiagnostics = onDiagnostics;
    this.onRun = onRun;
    this.setup = h('select', { onchange: () => this.#loadSetup() });
    this.setupText = h('textarea', { rows: 8, spellcheck: 'false', placeholder: '{"machine": {}, "workpiece": {"features": []}}' });
    this.setupText.addEventListener('input', () => this.#typedSetup());
    this.workpiece = new WorkpieceForm((features) => this.#shaped(features));
    this.setupName = h('input', { type: 'text', autocomplete: 'off', spellcheck: 'false' });
    this.parameters = h('textarea', { rows: 1, spellcheck: 'false', placeholder: 'Q1 = 25' });
    this.watch = h('input', { type: 'text', name: 'watch', autocomplete: 'off', spellcheck: 'false', placeholder: 'Q1 QS3' });
    this.startBlock = h('input', { type: 'text', name: 'start_block', inputmode: 'numeric', autocomplete: 'off', placeholder: '0' });
    this.subject = Object.fromEntries(['part_id', 'order'].map((name) => [name, h('input', { type: 'text', name, autocomplete: 'off', spellcheck: 'false', maxlength: 200 })]));
    this.note = h('p.note', { role: 'alert' });
    this.start = h('button.primary', { type: 'submit' }, t('programs.run'));
    this.cancel = h('button', { type: 'button', hidden: true, onclick: () => this.#cancel() }, t('programs.cancel'));
    this.state = h('p.unseen', { role: 'status' });
    this.report = h('div.report');
    this.element = h('section.run', h('h2', t('programs.run_title')),
      h('form', { novalidate: true, onsubmit: (event) => { event.preventDefault(); this.run(); } },
        h('div.pair', field(t('programs.setup'), this.setup), field(t('programs.parameters'), this.parameters)),
        h('p.actions', this.start, this.cancel),
        h('details', { ontoggle: ({ target }) => target.open && this.#showWorkpiece() }, h('summary', t('programs.setup_text')), this.workpiece.element,
          h('details', h('summary', t('programs.setup_whole')), field(t('programs.setup_json'), this.setupText)),
          h('div.line', field(t('programs.setup_name'), this.setupName),
            h('button', { type: 'button', onclick: () => this.#storeSetup() }, t('programs.store_setup')))),
        this.#folded(), this.note),
      this.earlier, this.state);
  }

  /** What few runs need: it is named where it is folded. */
  #folded() {
    const inputs = [...Object.values(this.subject), this.watch, this.startBlock];
    const summary = h('summary', t('programs.more'));
    const name = () => { summary.textContent = [t('programs.more'), ...inputs.map(({ value }) => value.trim())].filter(Boolean).join(' · '); };
    return h('details.of-more', { oninput: name }, summary, h('div.line', Object.entries(this.subject).map(([of, input]) => field(t(`field.${of}`), input)),
      field(t('steps.watch'), this.watch), field(t('steps.start'), this.startBlock)));
  }

  /** @param chosen the name of a setup */
  async show(program, chosen) {
    this.program = program;
    const names = await listSetups();
    this.setup.replaceChildren(h('option', { value: '' }, t('programs.own_setup')), ...names.map((name) => h('option', { value: name }, name)));
    this.setup.value = names.includes(chosen) ? chosen : '';
    if (this.setup.value) await this.#loadSetup();
    await this.#listEarlier();
  }

  /** The line of a program that was touched, this one or one that it calls: shows the move that it commands. */
  toLine(line, program = this.program) {
    this.slider?.toLine(program, line);
  }

  showBreaks() {
    this.slider?.panel?.showBreaks();
  }

  /** Another program is opened: what comes of a run of the one before is not shown below it. */
  open(program) {
    this.program = program;
    this.wanted = undefined;
    this.#forget();
    for (const text of [this.note, this.state]) text.textContent = '';
    this.report.replaceChildren();
  }

  leave() {
    this.wanted = undefined;
    this.#forget();
  }

  /** Gives up the figure of a run. */
  #forget() {
    this.shown = undefined;
    this.figure?.destroy();
    this.slider = null;
    this.figure = null;
  }

  async #listEarlier() {
    const runs = await listRuns(this.program, MOST_RUNS);
    refill(this.earlier, runs.length > 0 && h('h3', t('programs.earlier')), runs.length > 0 && h('ul', runs.map(({ id, status, created_at: at }) => h('li', h('button.quiet', {
      type: 'button', 'aria-current': id === this.shown && 'true', onclick: () => this.#try(() => this.#openRun(id)),
    }, `${t(`run.${status}`)} · ${dateTime(new Date(at))}`)))));
  }

  async #openRun(id) {
    this.onRun(id, this.setup.value);
    await this.showRun(id);
  }

  /** Shows a run, unless another, or another program, is asked for before it is here. */
  async showRun(id) {
    this.wanted = id;
    await this.#show(await (await request('GET', url(['runs', id]))).json());
  }

  async #show(run) {
    if (this.wanted !== run.id) return;
    this.#forget();
    this.state.textContent = [t(`run.${run.status}`), run.verdict && t(`verdict.${run.verdict}`)].filter(Boolean).join(', ');
    this.shown = run.id;
    const onMoves = (slider, figure) => {
      if (this.shown !== run.id) return figure.destroy();
      Object.assign(this, { slider, figure });
      return this.onMove(slider.trace.at(slider.trace.length - 1));
    };
    const report = await runReport(run, { onMoves, onMove: this.onMove });
    if (this.shown !== run.id) return;
    this.report.replaceChildren(...report);
    await this.#listEarlier();
  }

  async #loadSetup() {
    this.setupName.value = this.setup.value;
    await this.#try(async () => {
      if (this.setup.value) this.setupText.value = JSON.stringify(JSON.parse(await readSetup(this.setup.value)), null, 1);
      if (!this.workpiece.element.hidden) await this.#showWorkpiece();
    });
  }

  /** The features of the setup as a form, where its text can be read. */
  #showWorkpiece() {
    return this.#try(async () => {
      await this.workpiece.show(JSON.parse(this.setupText.value.trim() || '{}').workpiece?.features);
    });
  }

  /** Features that were filled in go into the text, which is what is run from now on. */
  #shaped(features) {
    const setup = JSON.parse(this.setupText.value.trim() || '{}');
    this.setupText.value = JSON.stringify({ ...setup, workpiece: { ...setup.workpiece, features } }, null, 1);
    this.setup.value = '';
  }

  #typedSetup() {
    this.setup.value = '';
    if (!this.workpiece.element.hidden) this.#showWorkpiece();
  }

  #storeSetup() {
    return this.#try(async () => {
      const name = this.setupName.value.trim();
      const text = this.setupText.value;
      if (!await writeOrAsk(name, (conditions) => writeSetup(name, text, conditions))) return;
      await this.show(this.program, name);
      this.note.textContent = t('programs.setup_stored', { name });
    });
  }

  /** The order of a run. @param texts of the programs whose parameters are watched where none is named. A setup that is chosen goes by its name, one that is typed by its text. */
  #order(texts) {
    const parameters = toJson(readParameters(this.parameters.value, (text) => t('programs.parameter_malformed', { text })));
    const setup = this.setup.value ? JSON.stringify(this.setup.value) : this.setupText.value.trim() || '{}';
    if (!this.setup.value) JSON.parse(setup);
    const subject = Object.entries(this.subject).filter(([, input]) => input.value.trim())
      .map(([name, input]) => `,"${name}":${JSON.stringify(input.value.trim())}`).join('');
    const begin = this.startBlock.value.trim();
    if (/\D/.test(begin)) throw new Error(t('steps.start_malformed', { text: begin }));
    const watch = this.watch.value.trim() ? this.watch.value.trim().toUpperCase().split(/[\s,;]+/) : parametersIn(texts.join('\n'));
    return `{"program":${JSON.stringify(onControl(this.program))},"setup":${setup},"parameters":${parameters},"watch":${JSON.stringify(watch)}${begin && `,"start_block":${Number(begin)}`}${subject}}`;
  }

  /** Runs the program as it is set up here: one run at a time, however often it is asked for. */
  async run() {
    if (this.isRunning) return;
    this.isRunning = true;
    const { program } = this;
    await this.#try(async () => {
      await this.beforeRun();
      const texts = [this.textOf(), ...await calledTexts(program, this.textOf())];
      if (this.program !== program) return;
      const response = await request('POST', url(['runs']), {
        body: this.#order(texts), headers: { 'Content-Type': 'application/json', Prefer: 'respond-async' },
      });
      const run = await response.json();
      this.running = run.id;
      this.cancel.hidden = false;
      this.start.disabled = true;
      if (this.program === program) {
        this.wanted = run.id;
        this.onRun(run.id, this.setup.value);
      }
      await this.#followRun(run.id);
    });
    this.isRunning = false;
    this.cancel.hidden = true;
    this.start.disabled = false;
  }

  async #followRun(id) {
    const lines = [];
    const state = h('p.headline', t('run.running'));
    for await (const event of readEvents(url(['runs', id, 'events']))) {
      const data = JSON.parse(event.data);
      if (event.type === 'output') lines.push(data.line);
      if (event.type === 'progress') state.textContent = t(`run.${data.status}`);
      if (event.type === 'end') return this.#show(data);
      if (this.wanted === id) this.report.replaceChildren(state, screenOf(lines));
    }
    return this.wanted === id ? this.showRun(id) : undefined;
  }

  #cancel() {
    return this.#try(() => request('DELETE', url(['runs', this.running])));
  }

  async #try(action) {
    this.note.textContent = '';
    try {
      await action();
    } catch (problem) {
      this.note.textContent = problem instanceof SyntaxError ? t('programs.setup_malformed', { reason: problem.message }) : explain(problem);
      if (problem.diagnostics?.length) this.onDiagnostics(problem.diagnostics);
    }
  }
}
