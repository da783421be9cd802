#pragma once

#include "formats/sheet/text_encoding.hpp"

namespace fitgauge::qif {

/// An element with its children. A view: valid until its reader continues.
class Element {
 public:
  struct Tree;
  Element(const Tree& tree, std::size_t place) : tree_(&tree), place_(place) {}

  const std::string& name() const;
  /// Its text without surrounding blanks; empty if it has none.
  std::string attribute(std::string_view name) const;
  /// Trimmed text of the first element at the path `Tolerance/MaxValue` below; empty if absent.
  std::string text(std::string_view path) const {
    const auto found = find(path);
    return found.empty() ? std::string() : found.front().own_text();
  }
  /// An attribute of the element, without surrounding blanks.
  std::string own_text() const;
  bool has(std::string_view path) const { return !find(path).empty(); }
  /// All elements at the path.
  std::vector<Element> find(std::string_view path) const {
    std::vector<Element> found;
    find(path, found);
    return found;
  }
  /// Returns names and values of AttributeStr and the other elements in `Attributes`, unchanged.
  std::vector<std::pair<std::string, std::string>> named_attributes() const;

 private:
  std::string_view attribute_as_it_is(std::string_view name) const;
  void find(std::string_view path, std::vector<Element>& found) const;

  const Tree* tree_;
  std::size_t place_;
};

/// Reads an XML document element by element in constant memory. Limits: kLargestElement bytes for
/// an element, kLargestTag bytes for a tag or comment, kMostAttributes for a tag, kDeepest nested
/// elements. Document types, and so own entities, are refused. Reads UTF-8, UTF-16 and every
/// encoding of one byte a character in iconv. Not thread-safe; unusable after an error.
class XmlReader {
 public:
  static constexpr std::size_t kLargestElement = std::size_t{4} << 20;
  static constexpr std::size_t kLargestTag = std::size_t{64} << 10;
  static constexpr std::size_t kMostAttributes = 256;
  static constexpr std::size_t kDeepest = 256;

  explicit XmlReader(Read read);
  XmlReader(XmlReader&&) noexcept;
  ~XmlReader();

  /// Goes to the next element. @returns false at the end of the document.
  /// @errors CsvMalformed with the line
  Result<bool> next();
  /// Its name, and the name of its parent; empty for the outermost.
  const std::string& name() const { return names_.back(); }
  std::string_view parent() const {
    return names_.size() < 2 ? std::string_view() : std::string_view(names_[names_.size() - 2]);
  }
  /// Depth of the element.
  std::size_t depth() const { return names_.size() - 1; }
  std::string_view name_space() const { return name_space_; }
  std::uint32_t line() const { return line_; }

  /// Skips all of it.
  void pass_over() { passed_ = names_.size(); }
  /// All of the element, which next() then passes over. @errors CsvMalformed with the line
  Result<Element> take();

 private:
  struct State;
  static constexpr std::size_t kNothing = std::numeric_limits<std::size_t>::max();

  std::unique_ptr<State> state_;
  std::vector<std::string> names_{};  ///< of the elements from the outermost on
  std::string name_space_{};
  std::uint32_t line_ = 1;
  std::size_t passed_ = kNothing;  ///< the depth below which elements are passed over
};

}  // namespace fitgauge::qif
