#include "cli/language_server.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <deque>
#include <map>
#include <set>

#include "base/allowance.hpp"
#include "base/text.hpp"
#include "cli/json_object.hpp"
#include "cli/message_stream.hpp"
#include "cli/open_programs.hpp"
#include "cli/program_help.hpp"
#include "nc/iso/parser.hpp"
#include "nc/klartext/printer.hpp"
#include "nc/program/check.hpp"

namespace fitgauge::cli {
namespace {

using klartext::Diagnostic;
using klartext::Severity;

constexpr int kParseError = -32700;
constexpr int kInvalidRequest = -32600;
constexpr int kMethodNotFound = -32601;
constexpr int kInvalidParams = -32602;
constexpr int kNotInitialized = -32002;
constexpr int kRequestFailed = -32803;

/// An error of JSON-RPC.
struct Refusal {
  Refusal() = default;
  Refusal(int number, std::string text) : code(number), message(std::move(text)) {}
  int code = 0;
  std::string message;
};
/// JSON.
using Reply = boost::system::result<std::string, Refusal>;

std::string list_of(const std::vector<std::string>& items) {
  return fmt::format("[{}]", fmt::join(items, ","));
}

std::string json_of(Place place) {
  return fmt::format(R"({{"line":{},"character":{}}})", place.line, place.character);
}
std::string json_of(Place begin, Place end) {
  return fmt::format(R"({{"start":{},"end":{}}})", json_of(begin), json_of(end));
}

/// A range of a finding, which counts in characters from 1.
std::string json_of(const EditedText& text, const SourceRange& range) {
  const std::size_t line = std::max(range.begin.line, 1U) - 1;
  const std::size_t last = std::max(range.end.line, range.begin.line + 0U);
  return json_of(text.place_of_column(line, range.begin.column),
                 text.place_of_column(std::max(last, 1UL) - 1, range.end.column));
}

std::string edit_of(const std::string& range, std::string_view by) {
  return JsonObject().add_raw("range", range).add("newText", by).text();
}

std::string whole_line(const EditedText& text, std::size_t line) {
  return json_of({line, 0}, text.place(text.start(line) + text.line(line).size()));
}

std::optional<std::size_t> whole(const JsonValue& value) {
  std::uint32_t read = 0;
  const auto [stop, error] =
      std::from_chars(value.text.data(), value.text.data() + value.text.size(), read);
  const bool is_whole = value.is(JsonValue::Kind::Number) && error == std::errc{} &&
                        stop == value.text.data() + value.text.size();
  return is_whole ? std::optional<std::size_t>(read) : std::nullopt;
}

std::optional<Place> place_of(const JsonValue& value) {
  const auto line = whole(value.member("line"));
  const auto character = whole(value.member("character"));
  if (!line || !character) return std::nullopt;
  return Place{*line, *character};
}

std::string json_of(const OpenProgram& program, const Diagnostic& found) {
  constexpr int kSeverities[] = {3, 2, 1};  // information, warning, error
  JsonObject json;
  json.add_raw("range", json_of(program.text, found.range));
  json.add_raw("severity", std::to_string(kSeverities[static_cast<std::size_t>(found.severity)]));
  json.add("code", id(found.code)).add("source", "fitgauge").add("message", found.message);
  std::vector<std::string> notes;
  for (const auto& note : found.notes) {
    JsonObject location;
    location.add("uri", program.uri).add_raw("range", json_of(program.text, note.range));
    notes.push_back(
        JsonObject().add_raw("location", location.text()).add("message", note.message).text());
  }
  if (!notes.empty()) json.add_raw("relatedInformation", list_of(notes));
  return json.text();
}

class LanguageServer {
 public:
  ExitCode run();

 private:
  using Handler = Reply (LanguageServer::*)(const JsonValue& params);
  using Listener = void (LanguageServer::*)(const JsonValue& params);
  struct Request {
    std::string_view method;
    Handler handle;
  };
  struct Notification {
    std::string_view method;
    Listener handle;
  };
  static const std::array<Request, 9> kRequests;
  static const std::array<Notification, 4> kNotifications;

  void handle(const std::string& text);
  void answer(const std::string& id, const JsonValue& message);
  void notify(std::string_view method, const JsonValue& params);
  static void respond(const std::string& id, const Reply& reply);
  static void send(std::string_view method, const JsonObject& params);
  static void complain(std::string_view message);
  void publish_all();
  void publish(OpenProgram& program);

  OpenProgram* program_of(const JsonValue& params);
  /// Calls `answer(program, place)` for a request about a place.
  template <class Answer>
  Reply at_place(const JsonValue& params, const Answer& answer);

  void open(const JsonValue& params);
  void change(const JsonValue& params);
  void close(const JsonValue& params);
  void save(const JsonValue&) {
    for (auto& [uri, program] : programs_.all()) program.is_stale = true;
  }

  Reply initialize(const JsonValue& params);
  Reply shutdown(const JsonValue&) {
    is_shut_down_ = true;
    return std::string("null");
  }
  Reply hover(const JsonValue& params);
  Reply complete(const JsonValue& params);
  Reply define(const JsonValue& params);
  Reply prepare_rename(const JsonValue& params);
  Reply rename(const JsonValue& params);
  Reply format(const JsonValue& params);
  Reply act(const JsonValue& params);

  OpenPrograms programs_;
  bool is_initialized_ = false;
  bool is_shut_down_ = false;
  bool is_over_ = false;
  bool has_snippets_ = false;
};

constexpr std::string_view kCapabilities =
    R"({"capabilities":{"positionEncoding":"utf-16",)"
    R"("textDocumentSync":{"openClose":true,"change":2,"save":true},"hoverProvider":true,)"
    R"("completionProvider":{"triggerCharacters":[" ","Q"]},"definitionProvider":true,)"
    R"("renameProvider":{"prepareProvider":true},"documentFormattingProvider":true,)"
    R"("codeActionProvider":{"codeActionKinds":["quickfix"]}},)"
    R"("serverInfo":{"name":"fitgauge","version":")" FITGAUGE_VERSION R"("}})";

const std::array<LanguageServer::Request, 9> LanguageServer::kRequests{
    {{"initialize", &LanguageServer::initialize},
     {"shutdown", &LanguageServer::shutdown},
     {"textDocument/hover", &LanguageServer::hover},
     {"textDocument/completion", &LanguageServer::complete},
     {"textDocument/definition", &LanguageServer::define},
     {"textDocument/prepareRename", &LanguageServer::prepare_rename},
     {"textDocument/rename", &LanguageServer::rename},
     {"textDocument/formatting", &LanguageServer::format},
     {"textDocument/codeAction", &LanguageServer::act}}};

const std::array<LanguageServer::Notification, 4> LanguageServer::kNotifications{
    {{"textDocument/didOpen", &LanguageServer::open},
     {"textDocument/didChange", &LanguageServer::change},
     {"textDocument/didClose", &LanguageServer::close},
     {"textDocument/didSave", &LanguageServer::save}}};

ExitCode LanguageServer::run() {
  MessageReader reader(STDIN_FILENO);
  while (!is_over_) {
    // Findings follow once no other keystroke waits.
    if (!reader.has_more()) publish_all();
    const auto message = reader.next();
    if (!message) break;
    if (message->problem.empty()) {
      handle(message->text);
    } else {
      respond("null", Refusal{kParseError, message->problem});
    }
  }
  if (!is_over_) publish_all();
  return is_over_ && is_shut_down_ ? ExitCode::Good : ExitCode::Rework;  // 1, as LSP has it
}

void LanguageServer::handle(const std::string& text) {
  const auto message = parse_document(text);
  if (!message) return respond("null", Refusal{kParseError, message.error().message});
  const JsonValue& method = message->member("method");
  const JsonValue* id = message->find("id");
  if (!message->is(JsonValue::Kind::Object) ||
      (!method.is(JsonValue::Kind::String) &&
       (id == nullptr || (!message->find("result") && !message->find("error"))))) {
    return respond("null", Refusal{kInvalidRequest, "a message is an object with a method"});
  }
  if (id == nullptr) return notify(method.text, message->member("params"));
  if (!method.is(JsonValue::Kind::String)) return;  // the answer to nothing that was asked
  if (!id->is(JsonValue::Kind::Number) && !id->is(JsonValue::Kind::String))
    return respond("null", Refusal{kInvalidRequest, "id must be a number or a string"});
  answer(id->is(JsonValue::Kind::String) ? json_quoted(id->text) : id->text, *message);
}

void LanguageServer::answer(const std::string& id, const JsonValue& message) {
  const std::string& method = message.member("method").text;
  const auto* found = std::ranges::find(kRequests, method, &Request::method);
  if (is_shut_down_)
    return respond(id, Refusal{kInvalidRequest, "only exit may follow behind shutdown"});
  if (!is_initialized_ && method != "initialize")
    return respond(id, Refusal{kNotInitialized, "the first request is initialize"});
  if (found == kRequests.end())
    return respond(id, Refusal{kMethodNotFound, "there is no method " + method});
  respond(id, (this->*found->handle)(message.member("params")));
}

void LanguageServer::notify(std::string_view method, const JsonValue& params) {
  is_over_ = method == "exit";
  const auto* found = std::ranges::find(kNotifications, method, &Notification::method);
  if (found != kNotifications.end() && is_initialized_ && !is_shut_down_)
    (this->*found->handle)(params);
}

void LanguageServer::respond(const std::string& id, const Reply& reply) {
  JsonObject message;
  message.add("jsonrpc", "2.0").add_raw("id", id);
  if (reply) {
    message.add_raw("result", *reply);
  } else {
    JsonObject error;
    error.add_raw("code", std::to_string(reply.error().code)).add("message", reply.error().message);
    message.add_raw("error", error.text());
  }
  send_message(message.text());
}

void LanguageServer::send(std::string_view method, const JsonObject& params) {
  JsonObject message;
  message.add("jsonrpc", "2.0").add("method", method).add_raw("params", params.text());
  send_message(message.text());
}

/// Of a notification, which has no answer.
void LanguageServer::complain(std::string_view message) {
  send("window/logMessage", JsonObject().add_raw("type", "1").add("message", message));
}

void LanguageServer::publish_all() {
  for (auto& [uri, program] : programs_.all())
    if (program.is_stale) publish(program);
}

void LanguageServer::publish(OpenProgram& program) {
  programs_.check(program);
  std::vector<std::string> findings;
  for (const Diagnostic& found : program.found) findings.push_back(json_of(program, found));
  JsonObject params;
  params.add("uri", program.uri);
  if (program.version) params.add_raw("version", std::to_string(*program.version));
  send("textDocument/publishDiagnostics", params.add_raw("diagnostics", list_of(findings)));
}

OpenProgram* LanguageServer::program_of(const JsonValue& params) {
  const auto found =
      programs_.all().find(std::string(params.member("textDocument").text_of("uri")));
  return found == programs_.all().end() ? nullptr : &found->second;
}

const Refusal kNotOpen{kInvalidParams, "textDocument.uri must name a program that is open"};

template <class Answer>
Reply LanguageServer::at_place(const JsonValue& params, const Answer& answer) {
  OpenProgram* program = program_of(params);
  if (program == nullptr) return kNotOpen;
  const auto place = place_of(params.member("position"));
  if (!place || place->line >= program->text.lines())
    return Refusal{kInvalidParams, "position must be a line and a character of the program"};
  return answer(*program, *place);
}

void LanguageServer::open(const JsonValue& params) {
  const JsonValue& document = params.member("textDocument");
  const JsonValue& text = document.member("text");
  if (!document.member("uri").is(JsonValue::Kind::String) || !text.is(JsonValue::Kind::String))
    return complain("didOpen: textDocument must have uri and text");
  programs_.open(document.member("uri").text, text.text).version =
      whole(document.member("version"));
}

void LanguageServer::change(const JsonValue& params) {
  OpenProgram* program = program_of(params);
  if (program == nullptr) return complain("didChange: " + kNotOpen.message);
  for (const JsonValue& change : params.member("contentChanges").items) {
    const JsonValue& text = change.member("text");
    const JsonValue* range = change.find("range");
    const auto begin = range == nullptr ? Place{} : place_of(range->member("start"));
    const auto end = range == nullptr ? Place{} : place_of(range->member("end"));
    if (!text.is(JsonValue::Kind::String) || !begin || !end)
      return complain("didChange: a change must have text, and start and end in its range");
    const std::size_t last =
        range == nullptr ? program->text.text().size() : program->text.offset(*end);
    program->text.replace(program->text.offset(*begin), last, text.text);
  }
  program->version = whole(params.member("textDocument").member("version"));
  programs_.touch(*program);
}

void LanguageServer::close(const JsonValue& params) {
  OpenProgram* program = program_of(params);
  if (program == nullptr) return complain("didClose: " + kNotOpen.message);
  send("textDocument/publishDiagnostics",
       JsonObject().add("uri", program->uri).add_raw("diagnostics", "[]"));
  programs_.all().erase(program->uri);
}

Reply LanguageServer::initialize(const JsonValue& params) {
  if (is_initialized_) return Refusal{kInvalidRequest, "initialize comes once"};
  is_initialized_ = true;
  has_snippets_ = params.member("capabilities")
                      .member("textDocument")
                      .member("completion")
                      .member("completionItem")
                      .member("snippetSupport")
                      .boolean;
  return std::string(kCapabilities);
}

Reply LanguageServer::hover(const JsonValue& params) {
  return at_place(params, [](const OpenProgram& program, Place place) -> Reply {
    const std::string text = hover_text(program.text, place);
    if (text.empty()) return std::string("null");
    const JsonObject content = JsonObject().add("kind", "markdown").add("value", text);
    return JsonObject().add_raw("contents", content.text()).text();
  });
}

Reply LanguageServer::complete(const JsonValue& params) {
  return at_place(params, [this](const OpenProgram& program, Place place) -> Reply {
    const std::size_t cursor = program.text.offset(place);
    std::vector<std::string> items;
    for (const CompletionItem& item : completions(program.text, cursor, program.is_iso())) {
      const Place begin = program.text.place(program.text.start(place.line) + item.replace);
      JsonObject json;
      json.add("label", item.label).add_given("detail", item.detail);
      json.add_raw("insertTextFormat", has_snippets_ ? "2" : "1");
      json.add_raw("textEdit", edit_of(json_of(begin, place),
                                       has_snippets_ ? item.insert : plain_text(item.insert)));
      items.push_back(json.text());
    }
    return list_of(items);
  });
}

Reply LanguageServer::define(const JsonValue& params) {
  return at_place(params, [this](const OpenProgram& program, Place place) -> Reply {
    const auto target = programs_.definition(program, place.line);
    if (!target) return std::string("null");
    return JsonObject()
        .add("uri", target->uri)
        .add_raw("range", json_of({target->line, 0}, {target->line, 0}))
        .text();
  });
}

/// The parameter at a place, or nothing.
std::optional<WrittenParameter> parameter_at(const OpenProgram& program, Place place) {
  const std::size_t column = program.text.offset(place) - program.text.start(place.line);
  for (const auto& written : parameters_of(program.text.line(place.line))) {
    const bool is_cycles = written.is_cycles && cycle_at(program.text, place.line);
    if (written.begin <= column && column <= written.end && !is_cycles) return written;
  }
  return std::nullopt;
}

Reply LanguageServer::prepare_rename(const JsonValue& params) {
  return at_place(params, [](const OpenProgram& program, Place place) -> Reply {
    const auto written = parameter_at(program, place);
    if (!written) return std::string("null");
    const std::size_t start = program.text.start(place.line);
    return json_of(program.text.place(start + written->begin),
                   program.text.place(start + written->end));
  });
}

Reply LanguageServer::rename(const JsonValue& params) {
  return at_place(params, [&](const OpenProgram& program, Place place) -> Reply {
    const auto written = parameter_at(program, place);
    if (!written)
      return Refusal{kRequestFailed,
                     "only a Q, QL, QR or QS parameter that a program uses is renamed"};
    const auto found = programs_.rename(program, written->parameter, params.text_of("newName"));
    if (!found) return Refusal{kRequestFailed, found.error().message};
    JsonObject changes;
    for (const auto& [uri, file] : *found) {
      std::vector<std::string> edits;
      for (const auto& [begin, end] : file.places)
        edits.push_back(edit_of(json_of(begin, end), params.text_of("newName")));
      changes.add_raw(uri, list_of(edits));
    }
    return JsonObject().add_raw("changes", changes.text()).text();
  });
}

Reply LanguageServer::format(const JsonValue& params) {
  const OpenProgram* program = program_of(params);
  if (program == nullptr) return kNotOpen;
  std::string formatted;
  if (program->is_iso()) {
    formatted = renumbered(program->text);
  } else {
    const auto parsed = klartext::parse_program(program->text.text(), program->name.text());
    for (const Diagnostic& found : parsed.diagnostics) {
      if (found.severity != Severity::Error) continue;
      return Refusal{kRequestFailed, fmt::format("correct line {} first: {}",
                                                 found.range.begin.line, found.message)};
    }
    formatted = klartext::format_program(parsed.program);
  }
  if (formatted == program->text.text()) return std::string("[]");
  const auto range = json_of({0, 0}, program->text.place(program->text.text().size()));
  return list_of({edit_of(range, formatted)});
}

Reply LanguageServer::act(const JsonValue& params) {
  OpenProgram* program = program_of(params);
  const auto begin = place_of(params.member("range").member("start"));
  const auto end = place_of(params.member("range").member("end"));
  if (program == nullptr) return kNotOpen;
  if (!begin || !end) return Refusal{kInvalidParams, "range must have start and end"};
  if (program->is_stale) publish(*program);
  std::vector<std::string> actions;
  for (const Diagnostic& found : program->found) {
    if (found.range.begin.line < begin->line + 1 || found.range.begin.line > end->line + 1)
      continue;
    for (const Remedy& remedy : remedies(program->text, found)) {
      const std::string edit = edit_of(whole_line(program->text, remedy.line), remedy.by);
      const JsonObject changes = JsonObject().add_raw(program->uri, list_of({edit}));
      JsonObject action;
      action.add("title", remedy.title).add("kind", "quickfix");
      action.add_raw("isPreferred", remedy.is_preferred ? "true" : "false");
      action.add_raw("diagnostics", list_of({json_of(*program, found)}));
      action.add_raw("edit", JsonObject().add_raw("changes", changes.text()).text());
      actions.push_back(action.text());
    }
  }
  return list_of(actions);
}

}  // namespace

Outcome<ExitCode> run_nc_lsp(const Context&) { return LanguageServer().run(); }

}  // namespace fitgauge::cli
