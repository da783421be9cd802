#pragma once

#include <unordered_map>

namespace fitgauge::certificate {

/// The compiled-in font (TrueType) for one document. Characters get codes from 1 in the order of
/// their use. A character that the font lacks is drawn as a box, but can be copied.
class EmbeddedFont {
 public:
  struct Used {
    char32_t character = 0;
    std::uint16_t glyph = 0;
    std::uint16_t width = 0;  ///< in thousandths of the size
  };

  EmbeddedFont();
  std::uint16_t code(char32_t character);
  std::size_t width(char32_t character) { return used_.at(code(character)).width; }
  const std::vector<Used>& used() const { return used_; }  ///< by code
  /// The font as a file with only the used glyphs.
  std::string file() const;

 private:
  std::vector<Used> used_;
  std::unordered_map<char32_t, std::uint16_t> codes_;
};

/// A picture as packed in a PNG file: rows of 8-bit samples, each after its filter.
struct Picture {
  std::string packed{};
  std::uint32_t width = 0;  ///< in pixels
  std::uint32_t height = 0;
  int colours = 3;  ///< 1: grey

  bool empty() const { return packed.empty(); }
};

/// A PNG file of at most 1 MiB and 2000 x 2000 pixels, grey or RGB with 8 bits, neither transparent
/// nor interlaced.
/// @errors ConfigInvalid naming the file and what to do.
Result<Picture> read_picture(const std::string& path);

/// A PDF 1.7 with structure for screen readers (ISO 32000-1, 14.7 and 14.8), in one embedded font.
/// Packs its text page by page. Lengths are points from the lower left. Unusable after a failure.
class TaggedPdf {
 public:
  TaggedPdf(std::string_view title, float width, float height);

  void begin_page() {
    if (!pages_.empty()) end_page();
    pages_.push_back({reserve(), reserve(), reserve()});
  }
  /// Begins an element of the structure below the open one. @param more entries of its dictionary
  void open(std::string_view type, std::string more = {}) {
    open_.push_back({type, reserve(), pages_.back().page, std::move(more)});
  }
  void close();
  /// Operators of the page: the content of the open element.
  void mark(const std::string& operators);
  /// Writes operators that a screen reader skips.
  void decorate(const std::string& operators) {
    content_ += "/Artifact BMC\n" + operators + "EMC\n";
  }

  /// The operators of one line.
  std::string text(float x, float y, float size, std::string_view line);
  float width_of(std::string_view line, float size) {
    std::size_t width = 0;
    while (!line.empty()) width += font_.width(take_character(line));
    return static_cast<float>(width) * size / 1000;
  }
  /// Returns the text in pieces, each at most `room` wide, that end at blanks.
  std::vector<std::string> wrapped(std::string_view text, float size, float room);
  /// Adds the only picture of the document. @returns its operators
  std::string picture(const Picture& picture, float x, float y, float width, float height);
  /// A text as a string of PDF.
  static std::string string(std::string_view text);

  /// @param footer the operators below page n of m
  std::string finish(const std::function<std::string(std::size_t, std::size_t)>& footer);

 private:
  struct Place {  // of an object: in the file (1), or in a stream of objects (2)
    std::uint8_t kind = 0;
    std::uint32_t at = 0;
    std::uint16_t index = 0;
  };
  struct Element {
    std::string_view type;
    std::size_t number = 0;
    std::size_t page = 0;
    std::string more{};
    std::string kids{};
  };
  struct Page {  // numbers of its objects
    std::size_t page = 0;
    std::size_t footer = 0;
    std::size_t parents = 0;
  };

  std::size_t reserve() {
    places_.emplace_back();
    return places_.size() - 1;
  }
  void put(std::size_t number, std::string_view object);
  void put_stream(std::size_t number, const std::string& entries, std::string_view bytes,
                  bool is_packed = false);
  void flush();
  void end_page();
  void put_font();

  std::string out_;
  std::vector<Place> places_{1};
  std::string heads_;  ///< of the objects that wait to be packed
  std::string bodies_;
  std::vector<std::size_t> waiting_;
  std::string title_;
  std::string box_;
  EmbeddedFont font_;
  std::vector<Page> pages_;
  std::string content_;
  std::string parents_;  ///< the elements of the page's marked contents
  std::size_t marks_ = 0;
  std::vector<Element> open_;
  std::size_t picture_ = 0;
};

}  // namespace fitgauge::certificate
