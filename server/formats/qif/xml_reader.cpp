#include "formats/qif/xml_reader.hpp"

#include <fmt/format.h>
#include <libxml/tree.h>
#include <libxml/xmlreader.h>

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

#include "base/text.hpp"
#include "formats/dfq/lines.hpp"

namespace fitgauge::qif {
namespace {

const xmlChar* xml(const char* text) { return reinterpret_cast<const xmlChar*>(text); }

std::string_view view(const xmlChar* text) {
  return text == nullptr ? std::string_view() : reinterpret_cast<const char*>(text);
}

/// A text of the library's own memory.
std::string owned(xmlChar* text) {
  std::string copy(view(text));
  xmlFree(text);
  return copy;
}

xmlNode* as_node(void* node) { return static_cast<xmlNode*>(node); }

void find_below(xmlNode* node, std::string_view path, std::vector<Element>& found) {
  const std::size_t slash = path.find('/');
  const std::string_view name = path.substr(0, slash);
  for (xmlNode* child = node->children; child != nullptr; child = child->next) {
    if (child->type != XML_ELEMENT_NODE || (name != "*" && view(child->name) != name)) continue;
    if (slash == std::string_view::npos) {
      found.emplace_back(child);
    } else {
      find_below(child, path.substr(slash + 1), found);
    }
  }
}

}  // namespace

std::string Element::name() const { return std::string(view(as_node(node_)->name)); }

std::string Element::attribute(const char* name) const {
  return std::string(trim(owned(xmlGetNoNsProp(as_node(node_), xml(name)))));
}

std::vector<Element> Element::find(std::string_view path) const {
  std::vector<Element> found;
  find_below(as_node(node_), path, found);
  return found;
}

std::string Element::text(std::string_view path) const {
  const auto found = find(path);
  return found.empty() ? std::string() : found.front().own_text();
}

std::string Element::own_text() const {
  return std::string(trim(owned(xmlNodeGetContent(as_node(node_)))));
}

std::vector<std::pair<std::string, std::string>> Element::named_attributes() const {
  std::vector<std::pair<std::string, std::string>> named;
  for (const Element& each : find("Attributes/*")) {
    named.emplace_back(owned(xmlGetNoNsProp(as_node(each.node_), xml("name"))),
                       owned(xmlGetNoNsProp(as_node(each.node_), xml("value"))));
  }
  return named;
}

struct XmlReader::State {
  Read read;
  xmlTextReaderPtr reader = nullptr;
  std::string message{};  ///< of the first error
  std::uint32_t line = 0;
  bool passes_over = false;           ///< what was taken
  std::optional<std::size_t> left{};  ///< bytes that the element which is taken may still have

  void fail(std::string what) {
    if (message.empty()) message = std::move(what);
  }

  /// @returns how many bytes; 0 at the end, and below it after a failure.
  int fill(std::span<char> into) {
    if (left && *left == 0) {
      fail(fmt::format("has an element of more than {} MiB", kLargestElement >> 20));
      return -1;
    }
    if (left) into = into.first(std::min(into.size(), *left));
    const auto count = read(into);
    if (!count) {
      fail(count.error().message);
      return -1;
    }
    if (left) *left -= *count;
    return static_cast<int>(*count);
  }
};

XmlReader::XmlReader(Read read) : state_(std::make_unique<State>(State{.read = std::move(read)})) {
  state_->reader = xmlReaderForIO(
      [](void* context, char* into, int size) {
        return static_cast<State*>(context)->fill({into, static_cast<std::size_t>(size)});
      },
      nullptr, state_.get(), nullptr, nullptr, XML_PARSE_NONET | XML_PARSE_BIG_LINES);
  if (state_->reader == nullptr) return;
  xmlTextReaderSetStructuredErrorHandler(
      state_->reader,
      [](void* context, xmlErrorPtr error) {
        auto& state = *static_cast<State*>(context);
        if (state.line != 0 || error->level < XML_ERR_ERROR) return;
        state.line = static_cast<std::uint32_t>(error->line);
        state.fail(fmt::format("is not well-formed XML: {}", trim(error->message)));
      },
      state_.get());
}

XmlReader::~XmlReader() {
  if (state_->reader != nullptr) xmlFreeTextReader(state_->reader);
}

Error XmlReader::failure() const {
  const std::uint32_t line = state_->line == 0 ? this->line() : state_->line;
  return aqdef::at_line(line, state_->message.empty() ? "cannot be read" : state_->message);
}

Result<bool> XmlReader::next() {
  if (state_->reader == nullptr) return failure();
  for (;;) {
    const int read = std::exchange(state_->passes_over, false) ? xmlTextReaderNext(state_->reader)
                                                               : xmlTextReaderRead(state_->reader);
    if (read < 0 || !state_->message.empty()) return failure();
    if (read == 0) return false;
    const int type = xmlTextReaderNodeType(state_->reader);
    if (type == XML_READER_TYPE_DOCUMENT_TYPE || type == XML_READER_TYPE_ENTITY_REFERENCE) {
      return aqdef::at_line(line(),
                            "has a document type or an entity of its own (DOCTYPE), which is "
                            "refused: write the texts themselves");
    }
    if (type != XML_READER_TYPE_ELEMENT) continue;
    names_.resize(static_cast<std::size_t>(xmlTextReaderDepth(state_->reader)));
    names_.emplace_back(view(xmlTextReaderConstLocalName(state_->reader)));
    return true;
  }
}

std::string_view XmlReader::parent() const {
  return names_.size() < 2 ? std::string_view() : std::string_view(names_[names_.size() - 2]);
}

std::string XmlReader::name_space() const {
  return std::string(view(xmlTextReaderConstNamespaceUri(state_->reader)));
}

std::uint32_t XmlReader::line() const {
  if (state_->reader == nullptr) return 1;
  xmlNode* const node = xmlTextReaderCurrentNode(state_->reader);
  // A document type has none of its own.
  const long line = node == nullptr ? -1 : xmlGetLineNo(node);
  return static_cast<std::uint32_t>(line < 0 ? xmlTextReaderGetParserLineNumber(state_->reader)
                                             : line);
}

std::string XmlReader::attribute(const char* name) const {
  return std::string(trim(owned(xmlTextReaderGetAttribute(state_->reader, xml(name)))));
}

void XmlReader::pass_over() { state_->passes_over = true; }

Result<Element> XmlReader::take() {
  pass_over();
  state_->left = kLargestElement;
  xmlNode* const node = xmlTextReaderExpand(state_->reader);
  state_->left.reset();
  if (node == nullptr || !state_->message.empty()) return failure();
  return Element(node);
}

}  // namespace fitgauge::qif
