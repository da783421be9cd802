/** What the page takes from uPlot (scripts/cmake/bundle_web.mjs). */

export { default as uPlot } from 'uplot';
/** Its style sheet, as text. */
export { default as style } from 'uplot/dist/uPlot.min.css';
