#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/read.hpp"
#include "base/result.hpp"

namespace fitgauge::qif {

/// An element with all below it. A view: lives until its reader goes on.
class Element {
 public:
  explicit Element(void* node) : node_(node) {}

  std::string name() const;
  /// Without blanks around it; empty where there is none.
  std::string attribute(const char* name) const;
  /// Of the first element at the path `Tolerance/MaxValue` below, without blanks around it; empty
  /// where there is none.
  std::string text(std::string_view path) const;
  /// Its own, likewise.
  std::string own_text() const;
  bool has(std::string_view path) const { return !find(path).empty(); }
  /// All elements at the path.
  std::vector<Element> find(std::string_view path) const;
  /// Of AttributeStr and its brothers below `Attributes`, names and values as they are.
  std::vector<std::pair<std::string, std::string>> named_attributes() const;

 private:
  void* node_;
};

/// Reads an XML document element by element: memory does not grow with it, and an element that is
/// taken has at most kLargestElement bytes. A document type is refused, and with it every entity of
/// its own. Not thread-safe; of no more use after an error.
class XmlReader {
 public:
  static constexpr std::size_t kLargestElement = std::size_t{4} << 20;

  explicit XmlReader(Read read);
  XmlReader(const XmlReader&) = delete;
  XmlReader& operator=(const XmlReader&) = delete;
  ~XmlReader();

  /// Goes to the next element. @returns false at the end of the document.
  /// @errors CsvMalformed with the line
  Result<bool> next();
  /// Its name, and that of the element it stands in; empty for the outermost.
  const std::string& name() const { return names_.back(); }
  std::string_view parent() const;
  /// How many elements it stands in.
  std::size_t depth() const { return names_.size() - 1; }
  std::string name_space() const;
  std::uint32_t line() const;
  std::string attribute(const char* name) const;

  /// Passes over all of it.
  void pass_over();
  /// All of the element, which next() then passes over. @errors CsvMalformed with the line
  Result<Element> take();

 private:
  struct State;
  Error failure() const;

  std::unique_ptr<State> state_;
  std::vector<std::string> names_{};  ///< of the elements from the outermost on
};

}  // namespace fitgauge::qif
