/**
 * The uncertainty that the rule of a plan needs, where the budget of the gauge says it.
 *
 * Tried, and held here:
 * - Two characteristics with a guard band and one gauge; the first by simple acceptance: each has the uncertainty of the gauge
 */

import assert from 'node:assert/strict';
import { afterEach, before, describe, it } from 'node:test';

import { close, open } from './support/browser.mjs';
import { eventually } from './support/eventually.mjs';
import { scan } from './support/scanner.mjs';
import { browser, daemon } from './support/stage.mjs';

const BAND = { gauge: 'G-1', rule: 'guard_band' };

let page;

afterEach(() => close(page));

describe('the uncertainty of a gauge', () => {
  before(async () => {
    await daemon.send('PUT', '/v1/uncertainties/bore', { contributions: [{ name: 'gauge', standard_uncertainty: 0.8 }] });
    await daemon.send('PUT', '/v1/gauges-in-use/G-1', { calibration_due: '2099-03-31', uncertainty: 'bore' });
  });

  for (const [name, first] of [['banded', BAND], ['simple', { gauge: 'G-1' }]]) {
    it(`is that of each characteristic of a plan that needs one: the first is ${name}`, async () => {
      const part = name.toUpperCase();
      await daemon.send('PUT', `/v1/plans/${part}`, { characteristics: [{ name: `${name}-1`, designation: '25 H7', ...first }, { name: `${name}-2`, designation: '25 H7', ...BAND }] });
      page = await open(browser, daemon, `#/gauge?plan=${part}`);
      const filled = (um) => page.waitForFunction((wanted) => document.querySelector('[name="uncertainty_um"]').value === wanted, um);
      await page.waitForFunction(() => /0\.8/.test(document.querySelector('.gauge-note')?.textContent));
      await filled(first.rule ? '0.8' : '');
      await page.focus('#value');
      await scan(page, '25.010');
      await filled('0.8');
      await scan(page, '25.011');
      await eventually(async () => assert.deepEqual((await daemon.stored(`characteristic=${name}-2`)).map((record) => [record.measured_mm, record.uncertainty_um]), [[25.011, 0.8]]));
    });
  }
});
