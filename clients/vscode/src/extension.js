/** Starts `fitgauge nc lsp` for programs of HEIDENHAIN controls and gives files that hold one their language. */

import { languages, window, workspace } from 'vscode';
import { LanguageClient } from 'vscode-languageclient/node';

const LANGUAGE = 'klartext';
/** What an editor takes a `.h` for: a header of C. */
const TAKEN_FOR = new Set(['c', 'cpp', 'plaintext']);

let client;

/** Whether a text is a program, by its first line that is no comment. */
export function isProgram(text) {
  const first = text.split(/\r\n|\r|\n/).map((line) => line.trim()).find((line) => line !== '' && !line.startsWith(';'));
  return /^(\/?\s*\d*\s*BEGIN\s+PGM\b|%\S+\s+G7[01]\b)/i.test(first ?? '');
}

function recognize(document) {
  if (TAKEN_FOR.has(document.languageId) && /\.[hi]$/i.test(document.uri.path) && isProgram(document.getText())) {
    languages.setTextDocumentLanguage(document, LANGUAGE);
  }
}

export async function activate(context) {
  context.subscriptions.push(workspace.onDidOpenTextDocument(recognize));
  workspace.textDocuments.forEach(recognize);
  const settings = workspace.getConfiguration('fitgauge');
  const command = settings.get('path');
  const levels = settings.get('levels').flatMap((level) => ['--level', level]);
  client = new LanguageClient('fitgauge', 'fitgauge', { command, args: ['nc', 'lsp', ...levels] }, {
    documentSelector: [{ language: LANGUAGE }],
  });
  try {
    await client.start();
  } catch (error) {
    window.showErrorMessage(`fitgauge: '${command} nc lsp' does not start: install fitgauge, or set fitgauge.path (${error.message})`);
  }
}

export const deactivate = () => client?.stop();
