#include "cli/nc_commands.hpp"

#include <iostream>
#include <regex>

#include "cli/open_programs.hpp"

namespace fitgauge::cli {
namespace {

constexpr int kParseError = -32700;
constexpr int kInvalidRequest = -32600;
constexpr int kMethodNotFound = -32601;
constexpr int kInvalidParams = -32602;
constexpr int kNotInitialized = -32002;
constexpr int kRequestFailed = -32803;
/// A program of 8 MiB, each character escaped.
constexpr std::size_t kLargestMessage = std::size_t{64} << 20;

/// An error of JSON-RPC.
struct Refusal {
  Refusal() = default;
  Refusal(int number, std::string text) : code(number), message(std::move(text)) {}
  int code = 0;
  std::string message;
};
/// JSON.
using Reply = boost::system::result<std::string, Refusal>;

struct Server {
  OpenPrograms programs;
  Levels levels;
  bool is_initialized = false;
  bool is_shut_down = false;
  bool is_over = false;
  bool has_snippets = false;
};

std::string list_of(const std::vector<std::string>& items) {
  return fmt::format("[{}]", fmt::join(items, ","));
}

std::string json_of(Place begin, Place end) {
  return fmt::format(
      R"({{"start":{{"line":{},"character":{}}},"end":{{"line":{},"character":{}}}}})", begin.line,
      begin.character, end.line, end.character);
}

std::string json_of(const Edit& edit) {
  return fmt::format(R"({{"range":{},"newText":{}}})", json_of(edit.begin, edit.end),
                     json_string(edit.by));
}

std::string json_of(const Changes& changes) {
  JsonObject files;
  for (const auto& [uri, edits] : changes) {
    std::vector<std::string> items;
    for (const Edit& edit : edits) items.push_back(json_of(edit));
    files.add_raw(uri, list_of(items));
  }
  return fmt::format(R"({{"changes":{}}})", files.text());
}

std::string json_of(const OpenProgram& program, const SourceRange& range) {
  const auto [begin, end] = range;
  const std::size_t line = std::max(begin.line, 1U) - 1;
  return json_of(program.text.place_of_column(line, begin.column),
                 program.text.place_of_column(line, end.line == begin.line ? end.column : ~0U));
}

/// Places in other programs are left out.
std::string json_of(const OpenProgram& program, const klartext::Diagnostic& found) {
  constexpr int kSeverities[] = {3, 2, 1};  // information, warning, error
  std::vector<std::string> others;
  for (const klartext::DiagnosticNote& note : found.notes) {
    if (!note.program.empty()) continue;
    others.push_back(fmt::format(R"({{"location":{{"uri":{},"range":{}}},"message":{}}})",
                                 json_string(program.uri), json_of(program, note.range),
                                 json_string(note.message)));
  }
  return fmt::format(
      R"({{"range":{},"severity":{},"code":"{}","source":"fitgauge","message":{},"relatedInformation":{}}})",
      json_of(program, found.range), kSeverities[static_cast<std::size_t>(found.severity)],
      id(found.code), json_string(found.message), list_of(others));
}

std::optional<std::size_t> whole(const JsonValue& value) {
  if (!value.is(JsonValue::Kind::Number)) return std::nullopt;
  return read_number<std::uint32_t>(value.text);
}

std::optional<Place> place_of(const JsonValue& value) {
  const auto line = whole(value.member("line"));
  const auto character = whole(value.member("character"));
  return line && character ? std::optional<Place>({*line, *character}) : std::nullopt;
}

void send(std::string_view text) {
  fmt::print(stdout, "Content-Length: {}\r\n\r\n{}", text.size(), text);
  std::fflush(stdout);
}

void notify(std::string_view method, const JsonObject& params) {
  send(fmt::format(R"({{"jsonrpc":"2.0","method":"{}","params":{}}})", method, params.text()));
}

void respond(std::string_view id, const Reply& reply) {
  if (reply) return send(fmt::format(R"({{"jsonrpc":"2.0","id":{},"result":{}}})", id, *reply));
  send(fmt::format(R"({{"jsonrpc":"2.0","id":{},"error":{{"code":{},"message":{}}}}})", id,
                   reply.error().code, json_string(reply.error().message)));
}

void publish(Server& server) {
  for (auto& [uri, program] : server.programs.all()) {
    if (!program.is_stale) continue;
    server.programs.check(program);
    apply_levels(server.levels, program.found);
    std::vector<std::string> findings;
    for (const auto& found : program.found) findings.push_back(json_of(program, found));
    JsonObject params;
    params.add("uri", uri).add_raw("diagnostics", list_of(findings));
    if (program.version) params.add("version", *program.version);
    notify("textDocument/publishDiagnostics", params);
  }
}

/// Calls `answer(program)` with the program that textDocument names.
template <class Answer>
Reply with_program(Server& server, const JsonValue& params, const Answer& answer) {
  auto& all = server.programs.all();
  const auto found = all.find(std::string(params.member("textDocument").text_of("uri")));
  if (found == all.end())
    return Refusal{kInvalidParams, "textDocument.uri must name a program that is open"};
  return answer(found->second);
}

/// Calls `answer(program, place)` for a request about a place.
template <class Answer>
Reply at_place(Server& server, const JsonValue& params, const Answer& answer) {
  return with_program(server, params, [&](OpenProgram& program) -> Reply {
    const auto place = place_of(params.member("position"));
    if (!place || place->line >= program.text.lines())
      return Refusal{kInvalidParams, "position must be a line and a character of the program"};
    return answer(program, *place);
  });
}

Reply initialize(Server& server, const JsonValue& params) {
  if (server.is_initialized) return Refusal{kInvalidRequest, "initialize must be sent once"};
  server.is_initialized = true;
  const JsonValue& client = params.member("capabilities").member("textDocument");
  server.has_snippets =
      client.member("completion").member("completionItem").member("snippetSupport").boolean;
  return std::string(
      R"({"capabilities":{"positionEncoding":"utf-16",)"
      R"("textDocumentSync":{"openClose":true,"change":2,"save":true},"hoverProvider":true,)"
      R"("completionProvider":{"triggerCharacters":[" ","Q"]},"definitionProvider":true,)"
      R"("renameProvider":true,"documentFormattingProvider":true,)"
      R"("codeActionProvider":{"codeActionKinds":["quickfix"]}},)"
      R"("serverInfo":{"name":"fitgauge","version":")" FITGAUGE_VERSION R"("}})");
}

Reply did_open(Server& server, const JsonValue& params) {
  const JsonValue& document = params.member("textDocument");
  const JsonValue& text = document.member("text");
  if (document.text_of("uri").empty() || !text.is(JsonValue::Kind::String))
    return Refusal{kInvalidParams, "didOpen: textDocument must have uri and text"};
  server.programs.open(document.member("uri").text, text.text).version =
      whole(document.member("version"));
  return {};
}

Reply did_change(Server& server, const JsonValue& params) {
  return with_program(server, params, [&](OpenProgram& program) -> Reply {
    program.version = whole(params.member("textDocument").member("version"));
    program.is_stale = true;
    for (const JsonValue& change : params.member("contentChanges").items) {
      const JsonValue& range = change.member("range");
      const bool is_all = change.find("range") == nullptr;
      const auto begin = is_all ? Place{} : place_of(range.member("start"));
      const auto end = is_all ? program.text.end() : place_of(range.member("end"));
      if (!change.member("text").is(JsonValue::Kind::String) || !begin || !end)
        return Refusal{kInvalidParams, "didChange: a change must have text, and a whole range"};
      program.text.replace(*begin, *end, change.member("text").text);
    }
    return {};
  });
}

Reply did_close(Server& server, const JsonValue& params) {
  return with_program(server, params, [&](const OpenProgram& program) -> Reply {
    notify("textDocument/publishDiagnostics",
           JsonObject().add("uri", program.uri).add_raw("diagnostics", "[]"));
    server.programs.all().erase(std::string(program.uri));
    return {};
  });
}

Reply did_save(Server& server, const JsonValue&) {
  for (auto& [uri, program] : server.programs.all()) program.is_stale = true;
  return {};
}

Reply hover(Server& server, const JsonValue& params) {
  return at_place(server, params, [](const OpenProgram& program, Place place) -> Reply {
    const std::string text = hover_text(program.text, place);
    if (text.empty()) return std::string("null");
    return fmt::format(R"({{"contents":{{"kind":"markdown","value":{}}}}})", json_string(text));
  });
}

Reply complete(Server& server, const JsonValue& params) {
  return at_place(server, params, [&](const OpenProgram& program, Place place) -> Reply {
    static const std::regex kMark(R"(\$\{\d+:([^}]*)\})");
    std::vector<std::string> items;
    for (Completion& item : completions(program.text, place)) {
      if (!server.has_snippets) item.edit.by = std::regex_replace(item.edit.by, kMark, "$1");
      items.push_back(
          fmt::format(R"({{"label":{},"detail":{},"insertTextFormat":{},"textEdit":{}}})",
                      json_string(item.label), json_string(item.detail),
                      server.has_snippets ? 2 : 1, json_of(item.edit)));
    }
    return list_of(items);
  });
}

Reply define(Server& server, const JsonValue& params) {
  return at_place(server, params, [&](const OpenProgram& program, Place place) -> Reply {
    const auto target = server.programs.definition(program, place.line);
    if (!target) return std::string("null");
    return fmt::format(R"({{"uri":{},"range":{}}})", json_string(target->first),
                       json_of({target->second, 0}, {target->second, 0}));
  });
}

Reply rename(Server& server, const JsonValue& params) {
  return at_place(server, params, [&](const OpenProgram& program, Place place) -> Reply {
    const auto written = parameter_at(program.text, place);
    if (!written)
      return Refusal{kRequestFailed,
                     "only Q, QL, QR and QS parameters can be renamed: put the cursor on one"};
    const auto changes = server.programs.rename(program, *written, params.text_of("newName"));
    if (!changes) return Refusal{kRequestFailed, changes.error().message};
    return json_of(*changes);
  });
}

Reply format(Server& server, const JsonValue& params) {
  return with_program(server, params, [](const OpenProgram& program) -> Reply {
    const auto formatted = formatted_text(program);
    if (!formatted) return Refusal{kRequestFailed, formatted.error().message};
    return list_of({json_of(Edit{{0, 0}, program.text.end(), *formatted})});
  });
}

Reply act(Server& server, const JsonValue& params) {
  publish(server);
  return with_program(server, params, [&](const OpenProgram& program) -> Reply {
    const auto begin = place_of(params.member("range").member("start"));
    const auto end = place_of(params.member("range").member("end"));
    if (!begin || !end) return Refusal{kInvalidParams, "range must have start and end"};
    std::vector<std::string> actions;
    for (const auto& found : program.found) {
      const std::size_t line = found.range.begin.line;
      if (line <= begin->line || line > end->line + 1) continue;
      for (const Remedy& remedy : remedies(program.text, found)) {
        actions.push_back(fmt::format(
            R"({{"title":{},"kind":"quickfix","isPreferred":{},"diagnostics":[{}],"edit":{}}})",
            json_string(remedy.title), remedy.is_preferred, json_of(program, found),
            json_of(Changes{{program.uri, remedy.edits}})));
      }
    }
    return list_of(actions);
  });
}

Reply shut_down(Server& server, const JsonValue&) {
  server.is_shut_down = true;
  return std::string("null");
}

struct Method {
  std::string_view name;
  Reply (*handle)(Server& server, const JsonValue& params);
};
constexpr Method kMethods[] = {
    {"initialize", initialize},           {"shutdown", shut_down},
    {"textDocument/didOpen", did_open},   {"textDocument/didChange", did_change},
    {"textDocument/didClose", did_close}, {"textDocument/didSave", did_save},
    {"textDocument/hover", hover},        {"textDocument/completion", complete},
    {"textDocument/definition", define},  {"textDocument/rename", rename},
    {"textDocument/formatting", format},  {"textDocument/codeAction", act}};

Reply reply_to(Server& server, std::string_view method, const JsonValue& params) {
  if (server.is_shut_down) return Refusal{kInvalidRequest, "only exit is accepted after shutdown"};
  if (!server.is_initialized && method != "initialize")
    return Refusal{kNotInitialized, "the first request must be initialize"};
  const auto* found = std::ranges::find(kMethods, method, &Method::name);
  if (found != std::end(kMethods)) return found->handle(server, params);
  return Refusal{kMethodNotFound, fmt::format("unknown method {}", method)};
}

void handle(Server& server, const std::string& text) {
  const auto message = parse_document(text);
  if (!message) return respond("null", Refusal{kParseError, message.error().message});
  const JsonValue& method = message->member("method");
  const JsonValue& id = message->member("id");
  const bool is_notice = message->find("id") == nullptr;
  const bool is_text = id.is(JsonValue::Kind::String);
  if (!method.is(JsonValue::Kind::String) ||
      !(is_notice || is_text || id.is(JsonValue::Kind::Number)))
    return respond(
        "null",
        Refusal{kInvalidRequest,
                "a message must have a method; the id of a request must be a number or a text"});
  server.is_over = is_notice && method.text == "exit";
  if (server.is_over) return;
  const Reply reply = reply_to(server, method.text, message->member("params"));
  if (!is_notice) return respond(is_text ? json_string(id.text) : id.text, reply);
  if (reply.has_error() && reply.error().code == kInvalidParams)
    notify("window/logMessage",
           JsonObject().add_raw("type", "1").add("message", reply.error().message));
}

/// The next message; none at the end. After a wrong header: an error, then the next header.
std::optional<Reply> next_message(bool& is_lost) {
  constexpr std::string_view kLength = "content-length:";
  const auto lose = [&is_lost](std::string problem) {
    is_lost = true;
    return Reply(Refusal{kParseError, std::move(problem)});
  };
  std::optional<std::size_t> length;
  for (char buffer[8192];;) {
    std::cin.getline(buffer, sizeof buffer);
    const auto size = std::cin.gcount() - (std::cin.good() ? 1 : 0);
    std::string_view line(buffer, static_cast<std::size_t>(std::max<std::streamsize>(size, 0)));
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (std::cin.eof() && (is_lost || (line.empty() && !length))) return std::nullopt;
    if (std::cin.eof()) return lose("the input ends in the middle of a header");
    std::cin.clear();  // the rest of a line that is too long comes next
    const std::size_t at = ascii_lower(line).rfind(kLength);
    if (line.empty() && length) break;
    const bool passes = is_lost || line.empty() || line.starts_with("Content-Type:");
    if (at == line.npos && passes) continue;
    if (at == line.npos || (at != 0 && !is_lost))
      return lose(
          fmt::format("a header must be NAME: VALUE; got '{}'", first_characters(line, 40)));
    is_lost = false;
    const JsonValue value{
        JsonValue::Kind::Number, {}, std::string(trim(line.substr(at + kLength.size())))};
    length = whole(value);
    if (!length || *length > kLargestMessage)
      return lose(fmt::format("Content-Length must be a whole number up to {}; got '{}'",
                              kLargestMessage, first_characters(value.text, 40)));
  }
  std::string text(*length, '\0');
  std::cin.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (std::cin.eof()) return lose(fmt::format("the input ends in a message of {} bytes", *length));
  return text;
}

/// `nc lsp`: a language server (LSP 3.17) on standard input and output, for both dialects, without
/// a service: diagnostics, hover, completion, definition, rename, formatting and remedies. Single
/// thread; unreadable input returns an error of JSON-RPC. Good if it ends after `shutdown`. @errors
/// LocalFile if the input ends before, Usage for a malformed level.
/// @param levels as of `nc check`
Outcome<ExitCode> run_nc_lsp(const Context&, const std::vector<std::string>& levels) {
  const auto read = TRY(read_levels(levels));
  std::ios::sync_with_stdio(false);
  Server server{.programs = {}, .levels = read};
  for (bool is_lost = false; !server.is_over;) {
    // Findings follow once no other keystroke waits.
    if (std::cin.rdbuf()->in_avail() <= 0) publish(server);
    const auto message = next_message(is_lost);
    if (!message) break;
    if (*message) {
      handle(server, **message);
    } else {
      respond("null", *message);
    }
  }
  return server.is_over && server.is_shut_down ? ExitCode::Good
                                               : ExitCode::Rework;  // 1, as LSP has it
}

}  // namespace

void add_lsp(CLI::App& nc, Action& chosen) {
  const auto [server, levels] =
      add_command(nc, "lsp", "Run a language server for an editor on standard input and output",
                  chosen, run_nc_lsp);
  add_levels(*server, *levels);
}

}  // namespace fitgauge::cli
