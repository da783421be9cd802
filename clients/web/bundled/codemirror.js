/** What the page takes from CodeMirror (scripts/cmake/bundle_web.mjs). */

export { defaultKeymap, history, historyKeymap } from '@codemirror/commands';
export { HighlightStyle, StreamLanguage, syntaxHighlighting } from '@codemirror/language';
export { search, searchKeymap } from '@codemirror/search';
export { EditorState, StateEffect, StateField } from '@codemirror/state';
export { Decoration, drawSelection, EditorView, gutter, GutterMarker, highlightActiveLine, keymap, lineNumbers } from '@codemirror/view';
export { tags } from '@lezer/highlight';
