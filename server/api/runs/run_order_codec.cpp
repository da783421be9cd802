#include "api/runs/run_codec.hpp"

#include "api/runs/setup_codec.hpp"

namespace fitgauge::api {

namespace {

using Kind = JsonValue::Kind;

/// Maximum number of contacts of a replay.
constexpr std::size_t kMostContacts = 10'000;

/// The form of a language of masks.
struct LanguageForm {
  static constexpr std::array kLanguages = {std::pair{"english", klartext::MaskLanguage::English},
                                            std::pair{"german", klartext::MaskLanguage::German},
                                            std::pair{"dutch", klartext::MaskLanguage::Dutch},
                                            std::pair{"italian", klartext::MaskLanguage::Italian},
                                            std::pair{"polish", klartext::MaskLanguage::Polish}};

  std::string schema(Side) const {
    std::vector<std::string_view> words;
    for (const auto& [word, language] : kLanguages) words.emplace_back(word);
    return schema::words(words);
  }
  void write(JsonWriter& json, klartext::MaskLanguage from) const {
    for (const auto& [word, language] : kLanguages) {
      if (language == from) json.value(word);
    }
  }
  bool read(FieldReader& fields, std::string_view name, klartext::MaskLanguage& to) const {
    const auto given = fields.text(name);
    if (!given) return false;
    for (const auto& [word, language] : kLanguages) {
      if (*given != word) continue;
      to = language;
      return true;
    }
    fields.report(ErrorCode::FieldInvalid, name,
                  "language must be one of: english, german, dutch, italian, polish");
    return false;
  }
};

/// The value of a parameter: a number, or for a QS a string.
std::optional<std::variant<double, std::string>> read_value(const JsonValue& value) {
  if (value.is(Kind::String)) return value.text;
  double number = 0;
  const char* const end = value.text.data() + value.text.size();
  if (!value.is(Kind::Number) ||
      std::from_chars(value.text.data(), end, number).ec != std::errc()) {
    return std::nullopt;
  }
  return number;
}

/// The form of parameters by name.
struct Parameters {
  std::string schema(Side) const { return schema::map(R"({"type":["number","string"]})"); }
  bool read(FieldReader& fields, std::string_view of,
            std::vector<interpreter::ParameterValue>& to) const {
    const JsonValue* object = fields.object(of);
    if (object == nullptr) return false;
    FieldErrors& errors = fields.errors();
    for (const auto& [name, value] : object->members) {
      const std::string pointer = pointer_to(fields.at(of), name);
      const auto parameter = interpreter::parse_parameter_name(name);
      if (!parameter) {
        errors.add(parameter.error().code, pointer, parameter.error().message);
        continue;
      }
      auto read = read_value(value);
      if (!read) {
        errors.add(value.is(Kind::Number) ? ErrorCode::NumberOutOfRange : ErrorCode::FieldType,
                   pointer, fmt::format("{} must be a number or a string within its range", name));
        continue;
      }
      interpreter::ParameterValue given{*parameter, *std::move(read)};
      const auto is_same = [&](const auto& other) { return other.parameter == *parameter; };
      if (std::ranges::any_of(to, is_same)) {
        errors.add(ErrorCode::FieldConflict, pointer,
                   fmt::format("{} is given twice: keep one", interpreter::name(*parameter)));
      } else if (const auto valid = interpreter::validate(given); !valid) {
        errors.add(valid.error().code, pointer, valid.error().message);
      } else {
        to.push_back(std::move(given));
      }
    }
    return true;
  }
};

/// The form of names of parameters.
struct ParameterNames {
  static constexpr std::size_t kMost = 32;

  std::string schema(Side) const { return schema::array(schema::text(), 0, kMost); }
  bool read(FieldReader& fields, std::string_view of, std::vector<klartext::QRef>& to) const {
    const JsonValue* names = fields.array(of);
    if (names == nullptr) return false;
    if (names->items.size() > kMost)
      fields.report(ErrorCode::FieldInvalid, of, "{} must have at most {} names", of, kMost);
    for (std::size_t i = 0; i < std::min(names->items.size(), kMost); ++i) {
      const JsonValue& item = names->items[i];
      const auto parameter = interpreter::parse_parameter_name(item.text);
      if (item.is(Kind::String) && parameter) {
        if (std::ranges::find(to, *parameter) == to.end()) to.push_back(*parameter);
      } else {
        fields.errors().add(item.is(Kind::String) ? parameter.error().code : ErrorCode::FieldType,
                            pointer_to(fields.at(of), i),
                            item.is(Kind::String) ? parameter.error().message
                                                  : "must be names of parameters such as \"Q5\"");
      }
    }
    return true;
  }
};

/// The form of a text in the records of a run.
struct Subject : Text {
  static constexpr bool kHasDefault = false;
  bool read(FieldReader& fields, std::string_view name, std::string& to) const {
    if (!Text::read(fields, name, to)) return false;
    const bool has_nul = to.find('\0') != std::string::npos;
    if (has_nul)
      fields.report(ErrorCode::FieldInvalid, name, "{} must not contain a NUL character", name);
    return !has_nul;
  }
};
constexpr Subject kSubject{{.longest = kLongestSubject}};

/// `[50.1, 40, -5]`: the ball's centre at the touch.
std::optional<machine::Vec3> read_point(const JsonValue& value) {
  if (!value.is(Kind::Array) || value.items.size() != 3) return std::nullopt;
  machine::Vec3 point;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto number = read_value(value.items[i]);
    if (!number || !std::holds_alternative<double>(*number)) return std::nullopt;
    point[i] = std::get<double>(*number);
  }
  return point;
}

/// The form of the contacts of a real machine.
struct Contacts {
  std::string schema(Side) const {
    return schema::array(schema::null_or(schema::array(schema::number(), 3, 3)), 0, kMostContacts);
  }
  bool read(FieldReader& fields, std::string_view name,
            std::vector<machine::ScriptedContact>& to) const {
    const JsonValue* const array = fields.array(name);
    if (array == nullptr) return false;
    if (array->items.size() > kMostContacts) {
      fields.report(ErrorCode::FieldInvalid, name, "{} must have at most {} contacts", name,
                    kMostContacts);
      return false;
    }
    for (std::size_t i = 0; i < array->items.size(); ++i) {
      const JsonValue& item = array->items[i];
      const auto point = item.is(Kind::Null) ? std::nullopt : read_point(item);
      if (!point && !item.is(Kind::Null)) {
        fields.errors().add(
            ErrorCode::FieldType, pointer_to(fields.at(name), i),
            "a contact must be [X, Y, Z] of the ball's centre, or null if nothing was touched");
      }
      to.push_back({.ball_centre = point});
    }
    return true;
  }
};

struct RunOrderBody {
  std::string program{};
  interpreter::RunOptions options{};
  app::RunSubject subject{};
  std::optional<std::vector<machine::ScriptedContact>> contacts{};
  std::vector<klartext::QRef> watch{};
};
void members(auto& v, RunOrderBody& order) {
  interpreter::RunOptions& options = order.options;
  std::nullptr_t elsewhere{};
  v.member("program", order.program, DiskFile{}, "TNC:\\nc_prog\\8255\\8255.h");
  v.optional("setup", elsewhere, Elsewhere{schema::one_of({schema::text(), schema::ref("Setup")})},
             "The name of a stored setup, or a setup");
  v.optional("parameters", options.parameters, Parameters{},
             "Q, QL and QR numbers and QS strings, as if an earlier program had left them");
  v.optional("limits", options.limits, "Limits; beyond them the run ends with limit_exceeded");
  v.optional("contacts_mm", order.contacts, Contacts{},
             "Contacts of a real machine: the ball's centre in the active system for each probing "
             "move in order, null if a move touched nothing. They replace the setup's workpiece");
  v.optional("on_stop", options.on_stop, OneOf<2>{"continue", "end"},
             "At STOP, M0 and Q281=2: continue as after NC Start, or end");
  v.optional(
      "unreadable", options.keeps_unreadable, OneOf<2>{"refuse", "error_block"},
      "Lines that are not Klartext: refuse the program, or fail when such a line is reached");
  v.optional("block_skip", options.block_skip, "Skip blocks that begin with /");
  v.optional("start_block", options.start_block, Integer{0, kMostBlocks},
             "The first block that runs, by its number, as after GOTO on a control: nothing before "
             "it has run");
  v.optional("watch", order.watch, ParameterNames{},
             "Q, QL, QR and QS whose values after each block stand in the trace");
  v.optional("language", options.language, LanguageForm{}, "Language of FN 16 masks");
  v.optional("part_id", order.subject.part_id, kSubject,
             "The part that is measured: in each record of the run");
  v.optional("order", order.subject.order, kSubject, "Order of the measurements");
}

/// The setup as JSON: the member itself, or the named one, which then replaces the name.
Result<void> put_setup_in_place(JsonValue& body, const FindSetup& find_setup, FieldErrors& errors) {
  const auto member =
      std::ranges::find_if(body.members, [](const auto& entry) { return entry.first == "setup"; });
  if (member == body.members.end() || !member->second.is(Kind::String)) return {};
  const auto found = find_setup(member->second.text);
  if (found) {
    member->second = TRY(parse_stored_json(found->text, "setup " + found->name));
    return {};
  }
  if (found.error().code != ErrorCode::SetupUnknown) return found.error();
  errors.add(found.error().code, "/setup", found.error().message);
  member->second = JsonValue{.kind = Kind::Object};
  return {};
}

}  // namespace

void members(auto& v, interpreter::RunLimits& limits) {
  v.optional("blocks", limits.blocks, Integer{1, kMostBlocks}, "Executed");
  double seconds = limits.time.count();
  v.optional("seconds", seconds,
             Number{0, kMostSeconds, Number::Ends::OpenBelow, "must be above 0 and at most 60"},
             "Seconds of computing, above 0; machining time has no limit");
  limits.time = std::chrono::duration<double>(seconds);
}

NamedSchema run_order_schema() { return order_schema<RunOrderBody>("RunOrder"); }

Result<app::RunOrder> decode_run_order(JsonValue body, const FindSetup& find_setup,
                                       const app::ControlTables& tables) {
  FieldErrors errors;
  std::string setup_name(body.text_of("setup"));
  TRY(put_setup_in_place(body, find_setup, errors));
  RunOrderBody order;
  read_body(body, "", errors, order);
  const JsonValue nothing{.kind = Kind::Object};
  const JsonValue* const given = body.find("setup");
  machine::Setup setup =
      decode_setup(given != nullptr ? *given : nothing, "/setup", tables, errors);
  if (given != nullptr) decode_builder(*given, "/setup", order.options, errors);
  if (auto error = errors.take()) return std::move(*error);
  return app::RunOrder{.program = *app::parse_file_path(order.program),
                       .setup = std::move(setup),
                       .options = std::move(order.options),
                       .request = json_text(body),
                       .contacts = std::move(order.contacts),
                       .subject = std::move(order.subject),
                       .setup_name = std::move(setup_name),
                       .watch = std::move(order.watch)};
}

}  // namespace fitgauge::api
