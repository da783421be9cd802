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

Attributes Element::named_attributes() const {
  Attributes named;
  for (const Element& each : find("Attributes/*"))
    named.emplace_back(each.attribute_as_it_is("name"), each.attribute_as_it_is("value"));
  return named;
}

XmlReader::XmlReader(Read read)
    : read_(std::move(read)), parser_(XML_ParserCreateNS(nullptr, kNamespaceEnd), XML_ParserFree) {
  XML_Parser parser = parser_.get();
  if (parser == nullptr) throw std::bad_alloc();
  XML_SetUnknownEncodingHandler(parser, characters_of, nullptr);
  XML_SetElementHandler(
      parser,
      [](void* reader, const char* name, const char** attributes) {
        static_cast<XmlReader*>(reader)->begin(name, attributes);
      },
      [](void* reader, const char*) { static_cast<XmlReader*>(reader)->end(); });
  XML_SetCharacterDataHandler(parser, [](void* reader, const char* text, int size) {
    static_cast<XmlReader*>(reader)->add({text, static_cast<std::size_t>(size)});
  });
  XML_SetStartDoctypeDeclHandler(
      parser, [](void* reader, const char*, const char*, const char*, int) {
        static_cast<XmlReader*>(reader)->fail(
            "has a DOCTYPE, which is refused: replace its entities by their texts");
      });
}

std::uint32_t XmlReader::line_now() const {
  return static_cast<std::uint32_t>(XML_GetCurrentLineNumber(parser_.get()));
}

void XmlReader::fail(std::string what) {
  if (error_) return;
  error_ = aqdef::at_line(line_now(), what);
  XML_StopParser(parser_.get(), XML_FALSE);
}

Result<bool> XmlReader::next() {
  if (error_) return *error_;
  if (std::exchange(has_ended_, false)) leave();
  XML_Parser parser = parser_.get();
  XML_SetUserData(parser, this);  // it may have moved
  XML_ParsingStatus state;
  for (;;) {
    XML_GetParsingStatus(parser, &state);
    const bool is_paused = state.parsing == XML_SUSPENDED;
    if (!is_paused && is_over_) return false;
    const int status = is_paused ? XML_ResumeParser(parser) : feed();
    if (status == XML_STATUS_ERROR && !error_)
      fail(fmt::format("is not well-formed XML: {}", XML_ErrorString(XML_GetErrorCode(parser))));
    if (status == XML_STATUS_OK &&
        fed_ > static_cast<std::uint64_t>(XML_GetCurrentByteIndex(parser)) + kLargestTag)
      fail(fmt::format("has a tag or a comment of more than {} KiB", kLargestTag >> 10));
    if (error_) return *error_;
    if (status == XML_STATUS_SUSPENDED) return true;
  }
}

/// Gives the parser the next piece, always a whole one, so that equal documents are read alike.
int XmlReader::feed() {
  auto* const room = static_cast<char*>(XML_GetBuffer(parser_.get(), kPiece));
  if (room == nullptr) throw std::bad_alloc();
  const std::span<char> piece(room, kPiece);
  std::size_t size = 0;
  while (!is_over_ && size < piece.size()) {
    const auto count = read_(piece.subspan(size));
    if (!count) {
      fail(count.error().message);
      return XML_STATUS_ERROR;
    }
    size += *count;
    is_over_ = *count == 0;
  }
  fed_ += size;
  return XML_ParseBuffer(parser_.get(), static_cast<int>(size), is_over_);
}

void XmlReader::check_size() {
  const auto at = static_cast<std::uint64_t>(XML_GetCurrentByteIndex(parser_.get()));
  if (at - begin_ > kLargestElement)
    fail(fmt::format("has an element of more than {} MiB", kLargestElement >> 20));
}

void XmlReader::begin(std::string_view name, const char** attributes) {
  if (names_.size() == kDeepest)
    return fail(fmt::format("has more than {} elements inside each other", kDeepest));
  Attributes given;
  for (std::size_t count = 0; *attributes != nullptr; attributes += 2) {
    if (++count > kMostAttributes)
      return fail(fmt::format("has more than {} attributes", kMostAttributes));
    if (std::string_view(*attributes).find(kNamespaceEnd) == std::string_view::npos)
      given.emplace_back(attributes[0], attributes[1]);
  }
  const std::size_t end = name.find(kNamespaceEnd);
  names_.emplace_back(name.substr(end + 1));
  const bool is_taken = !open_.empty();
  if (!is_taken && names_.size() > passed_) return;
  if (is_taken) {
    check_size();
    open_.push_back(tree_->nodes.size());
  } else {
    *tree_ = {};
    line_ = line_now();
    begin_ = static_cast<std::uint64_t>(XML_GetCurrentByteIndex(parser_.get()));
    name_space_ = name.substr(0, end == std::string_view::npos ? 0 : end);
    XML_StopParser(parser_.get(), XML_TRUE);
  }
  tree_->nodes.push_back(
      {.name = names_.back(), .attributes = std::move(given), .text_begin = tree_->text.size()});
}

void XmlReader::add(std::string_view text) {
  if (open_.empty()) return;
  check_size();
  tree_->text += text;
}

void XmlReader::end() {
  if (error_) return;  // an empty element ends also after begin() has failed
  XML_ParsingStatus state;
  XML_GetParsingStatus(parser_.get(), &state);
  has_ended_ = state.parsing == XML_SUSPENDED;
  if (has_ended_) return;
  leave();
  if (open_.empty()) return;
  check_size();
  close();
  if (open_.empty() && !error_) XML_StopParser(parser_.get(), XML_TRUE);
}

void XmlReader::close() {
  Element::Tree::Node& node = tree_->nodes[open_.back()];
  node.text_end = tree_->text.size();
  node.next = tree_->nodes.size();
  open_.pop_back();
}

Result<Element> XmlReader::take() {
  open_ = {0};
  if (has_ended_) {
    close();
  } else {
    TRY(next());
  }
  return Element(*tree_, 0);
}

}  // namespace fitgauge::qif
