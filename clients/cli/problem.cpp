#include "cli/http_client.hpp"

namespace fitgauge::cli {
namespace {

constexpr long kUnauthorized = 401;
constexpr long kForbidden = 403;
constexpr long kServerError = 500;

std::optional<std::size_t> line_of(const JsonValue& entry) {
  return read_number<std::size_t>(entry.text_of("line"));
}

ExitCode exit_code_of(const Answer& answer) {
  if (answer.status == kUnauthorized || answer.status == kForbidden) return ExitCode::KeyNeeded;
  if (answer.status >= kServerError || is_temporary(answer)) return ExitCode::NoAnswer;
  return ExitCode::Refused;
}

/// The detail, or the list of the fields, which has the detail with its place.
std::string sentence(const Problem& problem) {
  if (problem.fields.empty()) return problem.detail.empty() ? problem.title : problem.detail;
  std::string text;
  for (const FieldProblem& field : problem.fields)
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", field.pointer, field.detail);
  return text;
}

}  // namespace

std::optional<Problem> problem_of(const Answer& answer) {
  if (!answer.content_type.starts_with("application/problem+json")) return std::nullopt;
  const auto document = parse_document(answer.body);
  if (!document) return std::nullopt;
  Problem problem{.code = std::string(document->text_of("code")),
                  .title = std::string(document->text_of("title")),
                  .detail = std::string(document->text_of("detail")),
                  .where = std::string(document->text_of("where"))};
  // The detail describes all of an input that cannot be read.
  if (problem.code.ends_with(".malformed")) return problem;
  for (const JsonValue& entry : document->member("errors").items) {
    problem.fields.push_back({.pointer = std::string(entry.text_of("pointer")),
                              .line = line_of(entry),
                              .detail = std::string(entry.text_of("detail"))});
  }
  return problem;
}

Failure failure_of(const Answer& answer, const std::string& url) {
  const auto problem = problem_of(answer);
  if (!problem) {
    return {exit_code_of(answer),
            fmt::format(
                "{} returns status {} without a problem document: check that fitgauged runs there",
                url, answer.status)};
  }
  std::string text = sentence(*problem);
  if (answer.status == kUnauthorized) text += "; set FITGAUGE_KEY, or give a file with --key-file";
  if (answer.status == kForbidden) text += "; use a key with another role";
  return {exit_code_of(answer), std::move(text), answer.body};
}

bool is_temporary(const Answer& answer) {
  constexpr long kTimeout = 408;
  constexpr long kConflict = 409;
  constexpr long kTooMany = 429;
  switch (answer.status) {
    case kTimeout:
    case kTooMany:
    case 502:
    case 503:
    case 504: return true;
    case kConflict: {
      const auto problem = problem_of(answer);
      return problem && problem->code == "idempotency.in_progress";
    }
    default: return false;
  }
}

Outcome<Answer> expect_ok(Outcome<Answer> answer, const std::string& url) {
  if (!answer || answer->ok()) return answer;
  return failure_of(*answer, url);
}

Outcome<JsonValue> read_document(const Answer& answer, const std::string& url) {
  auto document = parse_document(answer.body);
  if (document) return *std::move(document);
  return Failure::of(ExitCode::NoAnswer, "{} does not return JSON: check that fitgauged runs there",
                     url);
}

}  // namespace fitgauge::cli
