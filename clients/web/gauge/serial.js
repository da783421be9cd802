/**
 * A gauge on a serial port, where the browser has Web Serial: each line it sends is read by a pattern, whole,
 * and its value goes where typed values go. What does not fit is told, never stored.
 */

import { field, h } from '../dom.js';
import { t } from '../i18n.js';
import { readStored, store } from '../stored.js';
import { GAUGE_LINE } from './reading.js';

const KEPT_BAUD = 'serial-baud';
const KEPT_PATTERN = 'serial-pattern';
const BAUDS = [1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200];
const LONGEST_LINE = 200;
/** What begins in a silence of so many ms begins a line: anything else, where reading begins, may be the end of one. */
const SILENCE_MS = 200;
/** What came while the page was busy is read within so many ms more. */
const BUSY_MS = 50;

/** Whether nothing comes for a while. @param coming the next that is read */
async function isSilent(coming) {
  const came = coming.then(() => false, () => false);
  const wait = (milliseconds) => new Promise((resolve) => { setTimeout(resolve, milliseconds, true); });
  return await Promise.race([came, wait(SILENCE_MS)]) && Promise.race([came, wait(BUSY_MS)]);
}

export class SerialGauge {
  /** @param onValue takes the text of a value; @param onUnread why a line is none, and the line, '' where it is lost; @param leaving ends it */
  constructor({ onValue, onUnread, leaving }) {
    Object.assign(this, { onValue, onUnread });
    this.baud = h('select', { name: 'serial_baud', onchange: () => store(KEPT_BAUD, this.baud.value) },
      BAUDS.map((baud) => h('option', { value: baud, selected: String(baud) === (readStored(KEPT_BAUD) ?? '9600') }, String(baud))));
    this.pattern = h('input', { type: 'text', name: 'serial_pattern', autocomplete: 'off', spellcheck: 'false', onchange: () => this.#keepPattern() });
    this.pattern.value = readStored(KEPT_PATTERN) ?? GAUGE_LINE;
    this.button = h('button', { type: 'button', onclick: () => (this.port ? this.#close() : this.#choose()) });
    this.state = h('p.aside', { role: 'status' });
    this.element = h('fieldset.fields', { hidden: !navigator.serial }, h('legend.label', t('serial.title')),
      field(t('serial.baud'), this.baud), field(t('serial.pattern'), this.pattern), h('p.actions', this.button, this.state));
    this.#say();
    leaving.addEventListener('abort', () => this.#close());
    // A port that was chosen before may be opened again without a question.
    navigator.serial?.getPorts().then(([port]) => { if (port && !leaving.aborted) this.#open(port); });
  }

  #keepPattern() {
    if (!this.pattern.value.trim()) this.pattern.value = GAUGE_LINE;
    store(KEPT_PATTERN, this.pattern.value);
    this.#say(this.#expression() ? '' : t('serial.bad_pattern'));
  }

  /** Null where the pattern is none. */
  #expression() {
    try {
      return new RegExp(`^(?:${this.pattern.value})$`);
    } catch {
      return null;
    }
  }

  async #choose() {
    const port = await navigator.serial.requestPort().catch(() => null);
    if (port) await this.#open(port);
  }

  async #open(port) {
    try {
      await port.open({ baudRate: Number(this.baud.value) });
    } catch {
      return this.#say(t('serial.refused'));
    }
    this.port = port;
    this.#say();
    await this.#read(port);
    if (this.port === port) this.#close();
    return undefined;
  }

  /** Until the port is closed or unplugged; a line with a fault of transmission is lost, what is left of it too, and said. */
  async #read(port) {
    while (this.port === port && port.readable) {
      const decoder = new TextDecoder('ascii');
      this.reader = port.readable.getReader();
      let rest = '';
      try {
        let coming = this.reader.read();
        let isWhole = await isSilent(coming);
        for (;; coming = this.reader.read()) {
          const { value, done } = await coming;
          if (done) return;
          const lines = (rest + decoder.decode(value, { stream: true })).split(/[\r\n]+/);
          rest = lines.pop().slice(0, LONGEST_LINE);
          const cut = isWhole ? '' : lines.shift()?.trim();
          isWhole ||= cut !== undefined;
          if (cut) this.onUnread(t('serial.cut', { line: cut }), cut);
          for (const line of lines.filter((each) => each.trim())) this.#take(line.trim());
        }
      } catch {
        this.onUnread(t('serial.fault'), '');
      } finally {
        this.reader.releaseLock();
      }
    }
  }

  #take(line) {
    const match = this.#expression()?.exec(line);
    if (match) this.onValue(match[1] ?? match[0]);
    else this.onUnread(t('serial.unread', { line }), line);
  }

  async #close() {
    const { port } = this;
    this.port = null;
    if (!port) return;
    await this.reader?.cancel().catch(() => {});
    await port.close().catch(() => {});
    this.#say();
  }

  #say(problem = '') {
    this.button.textContent = t(this.port ? 'serial.disconnect' : 'serial.connect');
    this.state.textContent = problem || (this.port ? t('serial.on') : '');
  }
}
