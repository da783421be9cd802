/** The plans on the page, open in `page`: their list, their form and what tests ask of them. */

import { afterEach } from 'node:test';

import { close, open } from './browser.mjs';
import { browser, daemon } from './stage.mjs';

export let page;
afterEach(async () => {
  if (page) await close(page);
  page = null;
});

export const plan = (part) => daemon.json(`/v1/plans/${part}`);
export const row = (number) => page.locator(`.characteristics > li:nth-child(${number})`);
export const field = (number, name) => row(number).locator(`.of-${name} :is(input, select, textarea)`);
export const noteOf = (number, name) => row(number).locator(`.of-${name} .note`).textContent();
export const names = () => page.$$eval('.characteristics .of-name input', (all) => all.map(({ value }) => value));
export const storePlan = () => page.click('.editor button[type="submit"]');
export const says = (text) => page.waitForFunction((wanted) => document.querySelector('.done')?.textContent.includes(wanted), text);
export const stored = (part) => says(`Plan ${part} is stored`);
export const openAt = async (service, address, options = {}) => {
  page = await open(browser, service, address, options);
};
export const visit = async (address = '#/plans', options = {}) => {
  await openAt(daemon, address, options);
  await page.waitForSelector('.drop');
};
export const edit = async (part) => {
  await visit(`#/plans/${part}`);
  await page.waitForSelector('.editor:not([hidden]) .characteristic');
};
