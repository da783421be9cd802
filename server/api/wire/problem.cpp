#include "api/wire/problem.hpp"

#include "base/json/json_writer.hpp"

namespace fitgauge::api {
namespace {

/// A field's place is its JSON pointer; formats with lines add the line.
void write_detail(JsonWriter& json, const Error& detail) {
  json.begin_object().member("pointer", std::string_view(detail.where));
  if (!detail.details.empty()) json.key("line").raw(detail.details.front().where);
  json.member("code", id(detail.code)).member("detail", std::string_view(detail.message));
  json.end_object();
}

void add_headers(const Error& error, int status, http::Response& response) {
  if (status == 401) response.with("WWW-Authenticate", "Bearer realm=\"fitgauge\"");
  if (status == 503 && error.code != ErrorCode::TablesInconsistent) {
    response.with("Retry-After", "1");
  }
}

}  // namespace

int status_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::Unauthenticated:
    case ErrorCode::KeyInvalid:
    case ErrorCode::KeyExpired: return 401;
    case ErrorCode::Forbidden:
    case ErrorCode::LogKeyUnknown:
    case ErrorCode::OriginRefused: return 403;
    case ErrorCode::ClassUnknown:
    case ErrorCode::NotFound:
    case ErrorCode::FileUnknown:
    case ErrorCode::SetupUnknown:
    case ErrorCode::RunUnknown:
    case ErrorCode::CycleUnknown:
    case ErrorCode::UncertaintyUnknown:
    case ErrorCode::GaugeUnknown:
    case ErrorCode::PlanUnknown:
    case ErrorCode::CatalogueUnknown:
    case ErrorCode::StudyUnknown:
    case ErrorCode::ConnectionUnknown:
    case ErrorCode::MeasurementUnknown: return 404;
    case ErrorCode::MethodNotAllowed: return 405;
    case ErrorCode::NotAcceptable: return 406;
    case ErrorCode::RequestTimeout: return 408;
    case ErrorCode::IdempotencyInProgress:
    case ErrorCode::LogPosition:
    case ErrorCode::MeasurementCorrected:
    case ErrorCode::MeasurementSimulated:
    case ErrorCode::ConnectionReadOnly:
    case ErrorCode::DocumentInUse:
    case ErrorCode::RunFinished:
    case ErrorCode::RunUnfinished: return 409;
    case ErrorCode::LengthRequired: return 411;
    case ErrorCode::PreconditionFailed: return 412;
    case ErrorCode::BodyTooLarge: return 413;
    case ErrorCode::TargetTooLong: return 414;
    case ErrorCode::MediaTypeUnsupported:
    case ErrorCode::EncodingUnsupported: return 415;
    case ErrorCode::ExpectationFailed: return 417;
    case ErrorCode::HeaderTooLarge: return 431;
    case ErrorCode::VersionUnsupported: return 505;
    case ErrorCode::Internal: return 500;
    case ErrorCode::TablesInconsistent:
    case ErrorCode::StorageUnavailable:
    case ErrorCode::StorageBusy:
    case ErrorCode::StorageCorrupt:
    case ErrorCode::Overloaded:
    case ErrorCode::LogForked:
    case ErrorCode::ShuttingDown:
    case ErrorCode::NotReady: return 503;
    case ErrorCode::ClassUndefinedForSize:
    case ErrorCode::SizeOutOfRange:
    case ErrorCode::LengthTooFine:
    case ErrorCode::LengthOutOfRange:
    case ErrorCode::NumberOutOfRange:
    case ErrorCode::RuleInvalid:
    case ErrorCode::RuleNoAcceptance:
    case ErrorCode::LimitsInvalid:
    case ErrorCode::LimitsNone:
    case ErrorCode::LimitsMixed:
    case ErrorCode::StatisticsTooFew:
    case ErrorCode::StatisticsZeroSpread:
    case ErrorCode::StatisticsUnbalanced:
    case ErrorCode::StatisticsTooMany:
    case ErrorCode::FiguresLimit:
    case ErrorCode::TableRowsInvalid:
    case ErrorCode::TableFileMalformed:
    case ErrorCode::IdempotencyKeyReused:
    case ErrorCode::RequestInvalid:
    case ErrorCode::FieldMissing:
    case ErrorCode::FieldUnknown:
    case ErrorCode::FieldType:
    case ErrorCode::FieldInvalid:
    case ErrorCode::FieldTooLong:
    case ErrorCode::FieldConflict:
    case ErrorCode::DrawingNoSizes:
    case ErrorCode::SetupInvalid:
    case ErrorCode::ProgramInvalid:
    case ErrorCode::LogRootMismatch:
    case ErrorCode::LogRecordInvalid:
    case ErrorCode::NoteUnverified:
    case ErrorCode::NoteMalformed:
    case ErrorCode::KeyMalformed:
    case ErrorCode::ProgramUnknown: return 422;
    default: return 400;
  }
}

http::Response problem(const Error& error, std::optional<int> given, const http::Request& request) {
  const int status = given.value_or(status_of(error.code));
  std::string body = json_object([&](JsonWriter& json) {
    json.member("type", "urn:fitgauge:problem:" + std::string(id(error.code)));
    json.member("title", title(error.code)).member("status", status);
    json.member("detail", error.message);
    json.member("instance", "urn:fitgauge:request:" + std::string(request.id_text()));
    json.member("code", id(error.code));
    if (!error.where.empty()) json.member("where", error.where);
    if (error.details.empty()) return;
    json.key("errors").begin_array();
    for (const Error& detail : error.details) write_detail(json, detail);
    json.end_array();
  });
  http::Response response(status, "application/problem+json", std::move(body));
  add_headers(error, status, response);
  return response;
}

}  // namespace fitgauge::api
