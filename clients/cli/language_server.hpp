#pragma once

#include "cli/context.hpp"

namespace fitgauge::cli {

/// `nc lsp`: a language server (LSP 3.17) on standard input and output, for both dialects, without
/// a service: diagnostics, hover, completion, definition, rename, formatting and remedies. Single
/// thread; what it cannot read is answered with an error of JSON-RPC. Good when it ends after
/// `shutdown`. @errors LocalFile when the input ends before.
Outcome<ExitCode> run_nc_lsp(const Context& context);

}  // namespace fitgauge::cli
