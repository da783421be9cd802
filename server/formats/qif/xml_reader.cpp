#include "formats/qif/qif.hpp"

#include <expat.h>
#include <iconv.h>

#include <cerrno>

namespace fitgauge::qif {
namespace {

constexpr char kNamespaceEnd = '\n';  ///< between a namespace and a name; no name has it
constexpr int kPiece = 16 << 10;      ///< bytes that the parser gets at a time

/// The characters of an encoding of one byte a character.
int characters_of(void*, const char* encoding, XML_Encoding* table) {
  const auto failed = reinterpret_cast<iconv_t>(-1);
  const iconv_t conversion = iconv_open("UTF-32LE", encoding);
  if (conversion == failed) return XML_STATUS_ERROR;
  int result = XML_STATUS_OK;
  for (int byte = 0; byte < 256; ++byte) {
    char in = static_cast<char>(byte);
    std::int32_t out = -1;
    char* from = &in;
    char* to = reinterpret_cast<char*>(&out);
    std::size_t in_left = 1;
    std::size_t out_left = sizeof out;
    iconv(conversion, nullptr, nullptr, nullptr, nullptr);
    const bool is_done = iconv(conversion, &from, &in_left, &to, &out_left) != std::size_t(-1);
    if (!is_done && errno == EINVAL) result = XML_STATUS_ERROR;  // the first byte of several
    table->map[byte] = is_done ? out : -1;
  }
  iconv_close(conversion);
  return result;
}

}  // namespace

using Attributes = std::vector<std::pair<std::string, std::string>>;

/// An element and all below it, in the order of the document.
struct Element::Tree {
  struct Node {
    std::string name;
    Attributes attributes;
    std::size_t text_begin = 0;
    std::size_t text_end = 0;  ///< with that of all below
    std::size_t next = 0;      ///< the place after all nested elements
  };

  std::vector<Node> nodes{};
  std::string text{};  ///< of all nodes
};

const std::string& Element::name() const { return tree_->nodes[place_].name; }

std::string_view Element::attribute_as_it_is(std::string_view name) const {
  for (const auto& [known, value] : tree_->nodes[place_].attributes) {
    if (known == name) return value;
  }
  return {};
}

std::string Element::attribute(std::string_view name) const {
  return std::string(trim(attribute_as_it_is(name)));
}

void Element::find(std::string_view path, std::vector<Element>& found) const {
  const std::size_t slash = path.find('/');
  const std::string_view name = path.substr(0, slash);
  const auto& nodes = tree_->nodes;
  for (std::size_t child = place_ + 1; child < nodes[place_].next; child = nodes[child].next) {
    if (name != "*" && nodes[child].name != name) continue;
    if (slash == std::string_view::npos) {
      found.emplace_back(*tree_, child);
    } else {
      Element(*tree_, child).find(path.substr(slash + 1), found);
    }
  }
}

std::string Element::own_text() const {
  const Tree::Node& node = tree_->nodes[place_];
  const std::string_view all = tree_->text;
  return std::string(trim(all.substr(node.text_begin, node.text_end - node.text_begin)));
}

std::vector<std::pair<std::string, std::string>> Element::named_attributes() const {
  std::vector<std::pair<std::string, std::string>> named;
  for (const Element& each : find("Attributes/*"))
    named.emplace_back(each.attribute_as_it_is("name"), each.attribute_as_it_is("value"));
  return named;
}

struct XmlReader::State {
  enum class Kind { Begin, Text, End };
  /// Events of the parser, in the order of the document.
  struct Event {
    Kind kind = Kind::Text;
    std::uint32_t line = 0;
    std::uint64_t at = 0;  ///< byte of the document
    std::string text{};    ///< or the name
    std::string name_space{};
    Attributes attributes{};  ///< those without a namespace
  };

  explicit State(Read document)
      : read(std::move(document)), parser(XML_ParserCreateNS(nullptr, kNamespaceEnd)) {
    if (parser == nullptr) throw std::bad_alloc();
    XML_SetUserData(parser, this);
    XML_SetUnknownEncodingHandler(parser, characters_of, nullptr);
    XML_SetElementHandler(
        parser,
        [](void* state, const char* name, const char** attributes) {
          static_cast<State*>(state)->begin(name, attributes);
        },
        [](void* state, const char*) {
          static_cast<State*>(state)->add(Kind::End, {});
          --static_cast<State*>(state)->depth;
        });
    XML_SetCharacterDataHandler(parser, [](void* state, const char* text, int size) {
      static_cast<State*>(state)->add(Kind::Text, {text, static_cast<std::size_t>(size)});
    });
    XML_SetStartDoctypeDeclHandler(
        parser, [](void* state, const char*, const char*, const char*, int) {
          static_cast<State*>(state)->fail(
              "has a DOCTYPE, which is refused: replace its entities by their texts");
        });
  }

  State& operator=(State&&) = delete;  // neither copied nor moved
  ~State() { XML_ParserFree(parser); }

  /// The next event, until it is consumed; null at the end of the document.
  Result<Event*> event() {
    while (next == events.size()) {
      events.clear();
      next = 0;
      if (error) return *error;
      if (is_over) return nullptr;
      feed();
    }
    return &events[next];
  }

  Event& take_event() { return events[next++]; }

  void fail(std::string what) {
    is_over = true;
    if (error) return;
    error = aqdef::at_line(static_cast<std::uint32_t>(XML_GetCurrentLineNumber(parser)), what);
    XML_StopParser(parser, XML_FALSE);
  }

  /// Gives the parser the next piece, always a whole one, so that equal documents are read alike.
  void feed() {
    auto* const room = static_cast<char*>(XML_GetBuffer(parser, kPiece));
    if (room == nullptr) throw std::bad_alloc();
    const std::span<char> piece(room, kPiece);
    std::size_t size = 0;
    while (!is_over && size < piece.size()) {
      const auto count = read(piece.subspan(size));
      if (!count) return fail(count.error().message);
      size += *count;
      is_over = *count == 0;
    }
    fed += size;
    if (XML_ParseBuffer(parser, static_cast<int>(size), is_over) == XML_STATUS_ERROR) {
      fail(fmt::format("is not well-formed XML: {}", XML_ErrorString(XML_GetErrorCode(parser))));
    } else if (fed > static_cast<std::uint64_t>(XML_GetCurrentByteIndex(parser)) + kLargestTag) {
      fail(fmt::format("has a tag or a comment of more than {} KiB", kLargestTag >> 10));
    }
  }

  void add(Kind kind, std::string_view text) {
    if (error) return;
    if (kind == Kind::Text && !events.empty() && events.back().kind == kind) {
      events.back().text += text;
      return;
    }
    events.push_back({.kind = kind,
                      .line = static_cast<std::uint32_t>(XML_GetCurrentLineNumber(parser)),
                      .at = static_cast<std::uint64_t>(XML_GetCurrentByteIndex(parser)),
                      .text = std::string(text)});
  }

  void begin(std::string_view name, const char** attributes) {
    if (++depth > kDeepest)
      fail(fmt::format("has more than {} elements inside each other", kDeepest));
    const std::size_t end = name.find(kNamespaceEnd);
    add(Kind::Begin, name.substr(end + 1));
    if (error) return;
    Event& event = events.back();
    if (end != std::string_view::npos) event.name_space = name.substr(0, end);
    std::size_t count = 0;
    for (; *attributes != nullptr; attributes += 2) {
      if (++count > kMostAttributes) {
        events.pop_back();
        fail(fmt::format("has more than {} attributes", kMostAttributes));
        return;
      }
      if (std::string_view(*attributes).find(kNamespaceEnd) == std::string_view::npos)
        event.attributes.emplace_back(attributes[0], attributes[1]);
    }
  }

  Read read;
  XML_Parser parser;
  std::vector<Event> events{};  ///< of the piece that was read last
  std::size_t next = 0;
  std::size_t depth = 0;
  std::uint64_t fed = 0;
  bool is_over = false;
  std::optional<Error> error{};  ///< behind the events
  Event begun{};                 ///< of the element where the reader is
  Element::Tree taken{};
};

XmlReader::XmlReader(Read read) : state_(std::make_unique<State>(std::move(read))) {}
XmlReader::XmlReader(XmlReader&&) noexcept = default;
XmlReader::~XmlReader() = default;

Result<bool> XmlReader::next() {
  for (;;) {
    const auto event = TRY(state_->event());
    if (event == nullptr) return false;
    State::Event& taken = state_->take_event();
    if (taken.kind == State::Kind::End) {
      names_.pop_back();
      if (names_.size() < passed_) passed_ = kNothing;
    }
    if (taken.kind != State::Kind::Begin) continue;
    names_.push_back(taken.text);
    if (names_.size() > passed_) continue;
    name_space_ = std::move(taken.name_space);
    line_ = taken.line;
    state_->begun = std::move(taken);
    return true;
  }
}

Result<Element> XmlReader::take() {
  const std::uint64_t begin = state_->begun.at;
  Element::Tree& tree = state_->taken;
  tree = {};
  std::vector<std::size_t> open;
  const auto add = [&](State::Event& event) {
    open.push_back(tree.nodes.size());
    tree.nodes.push_back({.name = std::move(event.text),
                          .attributes = std::move(event.attributes),
                          .text_begin = tree.text.size()});
  };
  add(state_->begun);
  for (;;) {
    // The parser refuses a document that ends inside an element.
    const auto next = TRY(state_->event());
    State::Event& event = *next;
    if (event.at - begin > kLargestElement) {
      return aqdef::at_line(event.line, "has an element of more than {} MiB",
                            kLargestElement >> 20);
    }
    if (event.kind == State::Kind::Begin) add(event);
    if (event.kind == State::Kind::Text) tree.text += event.text;
    if (event.kind == State::Kind::End) {
      Element::Tree::Node& node = tree.nodes[open.back()];
      node.text_end = tree.text.size();
      node.next = tree.nodes.size();
      open.pop_back();
      if (open.empty()) return Element(tree, 0);  // its end is for next()
    }
    state_->take_event();
  }
}

}  // namespace fitgauge::qif
