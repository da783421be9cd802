#pragma once

#include "cli/context.hpp"
#include "cli/json_object.hpp"
#include "cli/outcome.hpp"
#include "cli/problem.hpp"

namespace fitgauge::cli {

/// Prints what the service answered: as it came where JSON is asked for, else by `print`, which
/// gets the document. @errors those of the answer, and of a document that cannot be read.
template <class Print>
Outcome<ExitCode> show(const Context& context, const Outcome<Answer>& answer, const Print& print) {
  if (!answer) return answer.error();
  if (context.json) {
    context.print_document(answer->body);
    return ExitCode::Good;
  }
  const auto document = read_document(*answer, context.client.url());
  if (!document) return document.error();
  print(*document);
  return ExitCode::Good;
}

}  // namespace fitgauge::cli
