#pragma once

#include "cli/http_client.hpp"
#include "cli/json_object.hpp"

namespace fitgauge::cli {

/// The error in one field of a body.
struct FieldProblem {
  std::string pointer;                ///< JSON pointer: `/3/measured_mm`
  std::optional<std::size_t> line{};  ///< of the body, from 1, if the format has lines
  std::string detail;
};

/// A problem document (RFC 9457) of the service.
struct Problem {
  std::string code;
  std::string title;
  std::string detail;
  std::string where;  ///< the place in a body that could not be read, or empty
  std::vector<FieldProblem> fields{};
};

/// @returns nothing when the answer is something else: a proxy's page, another service.
std::optional<Problem> problem_of(const Answer& answer);

/// Returns the failure of a request in one line, with its remedy.
/// @param url the address that answered
Failure failure_of(const Answer& answer, const std::string& url);

/// Returns whether to repeat the request soon: the service is busy, starting or still at work.
bool is_temporary(const Answer& answer);

/// Returns a response that is a success. @errors as failure_of().
Outcome<Answer> expect_ok(Outcome<Answer> answer, const std::string& url);

/// Returns the document of a successful response. @errors NoAnswer if it is not JSON.
Outcome<JsonValue> read_document(const Answer& answer, const std::string& url);

}  // namespace fitgauge::cli
