/** Where the chart stands: drawn anew in another width, in other colours, on paper and back; a touch or the arrow keys pick a point. */

import { h } from '../dom.js';
import { t } from '../i18n.js';
import { ControlChart, PAPER } from './control_chart.js';
import { Stretch } from './stretch.js';

const NARROWEST = 300;

export class ChartPlace {
  #chart = null;
  #stale = true;
  #onPaper = false;
  #width = 0;
  #frame = 0;

  /** @param leaving ends it; @param onDrawn is told when the chart was drawn, and what is picked may be another point */
  constructor({ leaving, onDrawn }) {
    this.onDrawn = onDrawn;
    this.picked = null;
    this.shown = null;
    this.element = h('figure', { tabindex: 0, 'aria-label': t('trend.browse'), onkeydown: (event) => this.#browse(event) });
    this.stretch = new Stretch(() => this.#drawSoon());
    // Asked for in every frame, the width would make the browser lay out the page once more in each.
    const resized = new ResizeObserver(() => this.#measure());
    resized.observe(this.element);
    const print = ({ type }) => {
      this.#onPaper = type === 'beforeprint';
      this.#redraw();
    };
    for (const event of ['beforeprint', 'afterprint']) addEventListener(event, print, { signal: leaving });
    for (const look of ['(prefers-color-scheme: dark)', '(forced-colors: active)']) matchMedia(look).addEventListener('change', () => this.#redraw(), { signal: leaving });
    leaving.addEventListener('abort', () => {
      resized.disconnect();
      cancelAnimationFrame(this.#frame);
      this.#chart?.plot.destroy();
    });
  }

  /** Draws other values. @param shown {points, singles, chart}: what is drawn, its values one by one, the service's figures */
  show(shown) {
    this.shown = shown;
    if (!shown.points[this.picked]) this.picked = null;
    this.#width ||= Math.max(this.element.clientWidth, NARROWEST);
    this.#redraw();
  }

  /** There is nothing to draw. */
  clear(text) {
    this.shown = null;
    this.element.replaceChildren(h('p.empty', text));
  }

  goTo(index) {
    this.stretch.reveal(index);
    this.#pick(index);
  }

  #pick(index) {
    this.picked = index;
    this.#draw();
  }

  #browse(event) {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (!step || !this.shown) return;
    event.preventDefault();
    const { length } = this.shown.points;
    this.goTo(Math.min(Math.max((this.picked ?? length) + step, 0), length - 1));
  }

  #measure() {
    const now = Math.max(this.element.clientWidth, NARROWEST);
    if (now === this.#width) return;
    this.#width = now;
    this.#redraw();
  }

  /** Of other values, in another width or other colours, on paper and back. */
  #redraw() {
    this.#stale = true;
    this.#draw();
  }

  #draw() {
    if (!this.shown || this.#chart?.isTouched) return; // not under the finger
    const { points, singles, chart } = this.shown;
    if (this.#stale || !this.#chart.element.isConnected) {
      this.#chart?.plot.destroy();
      this.element.classList.toggle('on-paper', this.#onPaper);
      this.#chart = new ControlChart(this.element, points, singles, chart, {
        ...(this.#onPaper ? PAPER : { width: this.#width }), onPick: (index) => this.#pick(index), onStretch: (from, to) => this.stretch.choose(from, to),
      });
      this.#stale = false;
    }
    this.#chart.show(this.stretch.of(points.length), this.picked);
    this.onDrawn();
  }

  /** A slider says more often where it is than a screen shows. */
  #drawSoon() {
    this.#frame ||= requestAnimationFrame(() => {
      this.#frame = 0;
      this.#draw();
    });
  }
}
