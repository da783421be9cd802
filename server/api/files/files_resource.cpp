#include "api/resources.hpp"

#include "api/runs/run_codec.hpp"
#include "api/wire/request_facts.hpp"
#include "base/json/body_forms.hpp"
#include "service/jobs.hpp"

namespace fitgauge::api {
namespace {

using interpreter::ControlPath;

constexpr std::size_t kBodyLimit = std::size_t{8} << 20;

/// `nc_prog/8255/8255.h` is TNC:\nc_prog\8255\8255.h.
/// @errors those of ControlPath::parse, which drops blanks around a name: FilePathInvalid
Result<ControlPath> path_of(const Request& request) {
  std::string path(*request.text("path"));
  std::ranges::replace(path, '/', '\\');
  if (trim(path) != path || path.find(" \\") != path.npos || path.find("\\ ") != path.npos) {
    return Error::of(ErrorCode::FilePathInvalid,
                     "path '{}' must not have a blank at the beginning or the end of a name",
                     first_characters(path, 80));
  }
  return ControlPath::parse(std::string(app::kDrive) + path);
}

/// Returns the path of this service for a path of the control.
std::string href(std::string_view path) {
  std::string out(app::kFiles);
  for (const char c : path.substr(app::kDrive.size())) {
    constexpr std::string_view kPlain = "-._~!$&'()*+,;=:@";
    const bool plain = is_ascii_alphanumeric(c) || kPlain.find(c) != std::string_view::npos;
    constexpr std::string_view kDigits = "0123456789ABCDEF";
    const auto byte = static_cast<unsigned char>(c);
    if (c == '\\') {
      out += '/';
    } else if (plain) {
      out += c;
    } else {
      out += {'%', kDigits[byte >> 4U], kDigits[byte & 0xFU]};
    }
  }
  return out;
}

void put_file(const Services& services, const Request& request, Responder responder) {
  auto path = TRY_OR_FAIL(responder, path_of(request));
  const std::string location = href(path.text());
  const auto put = [&services, &request, path = std::move(path), location,
                    shared = share(std::move(responder))](const Result<std::string>& tag) {
    if (!tag) return shared->fail(tag.error());
    services.files.write(
        path, request.body(), caller_text(request), text_precondition_of(request),
        [shared, location, tag = *tag](const Result<bool>& created) {
          if (!created) return shared->fail(created.error());
          shared->answer(
              Response(*created ? 201 : 200).with("Location", location).with("ETag", tag));
        });
  };
  services.jobs.orders.run(
      [&request]() -> Result<std::string> { return etag_of_text(request.body()); }, put);
}

void get_file(const Services& services, const Request& request, Responder responder) {
  auto path = TRY_OR_FAIL(responder, path_of(request));
  services.files.read(
      std::move(path),
      answer_with(std::move(responder), [if_match = preconditions_of(request).if_match](
                                            store::FileContent file) {
        return with_tag(foreign_bytes("application/octet-stream", std::move(file.content)),
                        if_match);
      }));
}

void delete_file(const Services& services, const Request& request, Responder responder) {
  auto path = TRY_OR_FAIL(responder, path_of(request));
  services.files.remove(
      path, caller_text(request), text_precondition_of(request),
      services.runs.queued([&](const app::RunOrder& order) { return order.names(path); }),
      answer_with(std::move(responder), [](bool) { return Response(204); }));
}

struct FilesAnswer {
  std::vector<store::FileEntry> files{};
};
void members(auto& v, const FilesAnswer& answer) {
  v.member("files", answer.files, "Sorted by path");
}

void list_files(const Services& services, const Request& request, Responder responder) {
  std::string prefix(request.text("prefix").value_or(""));
  std::ranges::replace(prefix, '/', '\\');
  if (!ascii_iequals(prefix.substr(0, app::kDrive.size()), app::kDrive))
    prefix.insert(0, app::kDrive);
  services.files.list(std::move(prefix),
                      answer_with(std::move(responder), [](std::vector<store::FileEntry> files) {
                        return json_response(body_json(FilesAnswer{std::move(files)}));
                      }));
}

Result<Response> act_on(app::RunService& runs, const ControlPath& path, bool formats,
                        std::optional<std::string> draft) {
  if (formats) {
    auto text = TRY(runs.format(path));
    return Response(200, "text/plain; charset=utf-8", std::move(text));
  }
  auto found = TRY(runs.check(path, std::move(draft)));
  return Response(200, "application/json", diagnostics_json(found));
}

/// `action=check` and `action=format`.
void act_on_file(const Services& services, const Request& request, Responder responder) {
  const auto path = TRY_OR_FAIL(responder, path_of(request));
  const bool formats = request.text("action") == "format";
  std::optional<std::string> draft;
  if (!request.body().empty()) draft = std::string(request.body());
  services.jobs.orders.run(
      [&services, path, formats, draft = std::move(draft)]() mutable -> Result<Response> {
        auto done = act_on(services.runs, path, formats, std::move(draft));
        if (done) return done;
        Error error = std::move(done).error();
        // Here the request's path names the missing file.
        if (error.code == ErrorCode::ProgramUnknown) error.code = ErrorCode::FileUnknown;
        return error;
      },
      answer_by(share(std::move(responder))));
}

const Parameter kPath =
    path_parameter("path", "nc_prog/8255/8255.h is TNC:\\nc_prog\\8255\\8255.h");

}  // namespace

void members(auto& v, const store::FileEntry& file) {
  v.member("path", file.path, "Path on the control");
  v.member("href", file.path.empty() ? std::string() : href(file.path), "Address at this service");
  v.member("size", file.size, "Size in bytes");
  v.member("modified_at", file.modified_at, Time{}, "Time in UTC");
}

void add_file_schemas(Schemas& schemas) {
  schemas.push_back(answer_schema<FilesAnswer>("Files"));
  add_diagnostic_schemas(schemas);
}

void add_files_routes(Routes& add) {
  add("GET /v1/files listFiles viewer", list_files,
      {.summary = "The files of the control's disk",
       .parameters = {query("prefix", "Only paths with this beginning: nc_prog/8255/")},
       .outcomes = {{.meaning = "The files", .schema = "Files"}}});
  add("GET /v1/files/{path*} getFile viewer 404 412", get_file,
      {.summary = "A file, byte for byte",
       .parameters = with_preconditions(kPath),
       .response_types = {},
       .outcomes = {
           {.meaning = "Bytes of the file", .media_types = {"application/octet-stream"}}}});
  add("PUT /v1/files/{path*} putFile admin 412 422", put_file,
      {.summary = "Store a program, mask or table as it is on the control",
       .parameters = with_preconditions(kPath),
       .body = {.use = http::BodyUse::Required, .limit = kBodyLimit},
       .outcomes = {{.meaning = "Replaced"}, {.status = 201, .meaning = "Created"}}});
  add("DELETE /v1/files/{path*} deleteFile admin 404 409 412", delete_file,
      {.summary = "Delete a file",
       .parameters = with_preconditions(kPath),
       .outcomes = {{.status = 204, .meaning = "Deleted"}}});
  add("POST /v1/files/{path*} checkFile viewer 404 422", act_on_file,
      {.summary = "Check a program with those it calls, a mask or a table, or format a program; "
                  "nothing runs and nothing is stored",
       .description =
           "`check` takes the text of the body in place of the stored file, where there is "
           "a body: what an editor holds is checked before it is stored.",
       .parameters = {kPath,
                      {.name = "action",
                       .type = http::Words{{"check", "format"}},
                       .required = true,
                       .description = "check: the findings; format: the program as text, one blank "
                                      "between words, blocks numbered from 0"}},
       .body = {.use = http::BodyUse::Optional, .limit = kBodyLimit},
       .outcomes = {{.meaning = "Findings, or the formatted program",
                     .schema = "Diagnostics",
                     .media_types = {"application/json", "text/plain"}}}});
}

}  // namespace fitgauge::api
