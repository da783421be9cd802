#include <fmt/format.h>
#include <hpdf.h>
#include <qrencode.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <memory>
#include <stdexcept>
#include <string_view>

#include "formats/certificate/certificate.hpp"

extern "C" {
extern const char fitgauge_font_begin[];  // font.S
extern const char fitgauge_font_end[];
}

namespace fitgauge::certificate {
namespace {

constexpr float kMargin = 40;  // points, 1/72 inch
constexpr float kText = 8;
constexpr float kSmall = 7;
constexpr float kTitle = 16;
constexpr float kLeading = 1.35F;
constexpr float kCode = 84;

constexpr std::array<Column, 10> kInspection = {{
    {"Part", 0.11F, &Line::part},
    {"Characteristic", 0.11F, &Line::characteristic},
    {"Size", 0.08F, &Line::size},
    {"Limits / mm", 0.13F, &Line::limits},
    {"Measured / mm", 0.09F, &Line::measured},
    {"Dev. / \u00b5m", 0.07F, &Line::deviation},
    {"Verdict", 0.10F, &Line::verdict},
    {"Rule", 0.09F, &Line::rule},
    {"Gauge", 0.10F, &Line::gauge},
    {"Measured at", 0.12F, &Line::measured_at},
}};

void check(HPDF_STATUS status) {
  if (status != HPDF_OK) {
    throw std::runtime_error(fmt::format("the writer of PDF failed with {:#06x}", status));
  }
}

/// The compiled-in font as a file, which is all that the writer of PDF reads fonts from.
const std::string& font_file() {
  static const std::string path = [] {
    const std::size_t size = static_cast<std::size_t>(fitgauge_font_end - fitgauge_font_begin);
    const int file = memfd_create("font.ttf", MFD_CLOEXEC);
    if (file < 0 || write(file, fitgauge_font_begin, size) != static_cast<ssize_t>(size)) {
      throw std::runtime_error("there is no memory for the font");
    }
    return fmt::format("/proc/self/fd/{}", file);
  }();
  return path;
}

using Document = std::unique_ptr<std::remove_pointer_t<HPDF_Doc>, decltype(&HPDF_Free)>;
using Code = std::unique_ptr<QRcode, decltype(&QRcode_free)>;

/// Puts text on pages from the top down.
class Writer {
 public:
  Writer(HPDF_Doc document, Paper paper)
      : document_(document), size_(paper == Paper::A4 ? HPDF_PAGE_SIZE_A4 : HPDF_PAGE_SIZE_LETTER) {
    check(HPDF_UseUTFEncodings(document_));
    const char* const name = HPDF_LoadTTFontFromFile(document_, font_file().c_str(), HPDF_TRUE);
    font_ = name == nullptr ? nullptr : HPDF_GetFont(document_, name, "UTF-8");
    if (font_ == nullptr) check(HPDF_GetError(document_));
    begin_page();
  }

  float width() const { return HPDF_Page_GetWidth(page_) - 2 * kMargin; }
  float left() const { return kMargin; }
  float y() const { return y_; }
  void advance(float height) { y_ -= height; }
  /// Whether there is no room for so much above the footer.
  bool is_full(float height) const { return y_ - height < kMargin + 2 * kSmall; }

  void begin_page() {
    page_ = HPDF_AddPage(document_);
    if (page_ == nullptr) check(HPDF_GetError(document_));
    check(HPDF_Page_SetSize(page_, size_, HPDF_PAGE_LANDSCAPE));
    pages_.push_back(page_);
    y_ = HPDF_Page_GetHeight(page_) - kMargin;
  }

  void text(float x, float y, float size, const std::string& text) {
    check(HPDF_Page_BeginText(page_));
    check(HPDF_Page_SetFontAndSize(page_, font_, size));
    check(HPDF_Page_TextOut(page_, x, y, text.c_str()));
    check(HPDF_Page_EndText(page_));
  }

  /// A line of its own. One that is too long goes on in the next.
  void paragraph(float size, const std::string& text) {
    for (const std::string& line : wrapped(text, size, width())) {
      if (is_full(size * kLeading)) begin_page();
      advance(size * kLeading);
      this->text(left(), y_, size, line);
    }
  }

  void rule(float thickness) {
    check(HPDF_Page_SetLineWidth(page_, thickness));
    check(HPDF_Page_MoveTo(page_, left(), y_));
    check(HPDF_Page_LineTo(page_, left() + width(), y_));
    check(HPDF_Page_Stroke(page_));
  }

  void box(float x, float y, float side) {
    check(HPDF_Page_Rectangle(page_, x, y, side, side));
    check(HPDF_Page_Fill(page_));
  }

  /// The text in pieces no wider than `room`, at blanks where there are some.
  std::vector<std::string> wrapped(const std::string& text, float size, float room) {
    check(HPDF_Page_SetFontAndSize(page_, font_, size));
    std::vector<std::string> lines;
    std::string_view rest = text;
    while (!rest.empty()) {
      std::size_t end = fitting(rest, room);
      if (end < rest.size()) {
        const std::size_t blank = rest.substr(0, end + 1).rfind(' ');
        if (blank != rest.npos && blank > 0) end = blank;
      }
      lines.emplace_back(rest.substr(0, end));
      rest.remove_prefix(end);
      rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
    }
    return lines;
  }

  /// `page n of m` on each.
  void number_pages(const std::string& text) {
    for (std::size_t i = 0; i < pages_.size(); ++i) {
      page_ = pages_[i];
      const std::string line = fmt::format("{}page {} of {}", text, i + 1, pages_.size());
      check(HPDF_Page_SetFontAndSize(page_, font_, kSmall));
      const float wide = HPDF_Page_TextWidth(page_, line.c_str());
      this->text(left() + width() - wide, kMargin - kSmall, kSmall, line);
    }
  }

 private:
  /// How many bytes of whole characters fit, at least one character.
  std::size_t fitting(std::string_view text, float room) const {
    const auto after = [&](std::size_t at) {
      do ++at;
      while (at < text.size() && (text[at] & 0xC0) == 0x80);
      return at;
    };
    std::size_t end = after(0);
    while (end < text.size()) {
      const std::size_t next = after(end);
      if (HPDF_Page_TextWidth(page_, std::string(text.substr(0, next)).c_str()) > room) break;
      end = next;
    }
    return end;
  }

  HPDF_Doc document_;
  HPDF_PageSizes size_;
  HPDF_Font font_ = nullptr;
  HPDF_Page page_ = nullptr;
  std::vector<HPDF_Page> pages_;
  float y_ = 0;
};

using Columns = std::span<const Column>;

void write_table_head(Writer& out, Columns columns) {
  out.advance(kText * 2);
  float x = out.left();
  for (const Column& column : columns) {
    out.text(x, out.y(), kText, std::string(column.name));
    x += column.share * out.width();
  }
  out.advance(kText / 2);
  out.rule(0.8F);
}

void write_line(Writer& out, const Line& line, Columns columns) {
  constexpr float kGap = 6;
  std::vector<std::vector<std::string>> cells;
  std::size_t most = 1;
  for (const Column& column : columns) {
    cells.push_back(out.wrapped(line.*column.text, kText, column.share * out.width() - kGap));
    most = std::max(most, cells.back().size());
  }
  const float height = static_cast<float>(most) * kText * kLeading + kText / 2;
  if (out.is_full(height)) {
    out.begin_page();
    write_table_head(out, columns);
  }
  const float top = out.y();
  float x = out.left();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    float y = top;
    for (const std::string& text : cells[i]) {
      y -= kText * kLeading;
      out.text(x, y, kText, text);
    }
    x += columns[i].share * out.width();
  }
  out.advance(height);
  out.rule(0.2F);
}

void write_code(Writer& out, const std::string& text, float top) {
  const Code code(QRcode_encodeString8bit(text.c_str(), 0, QR_ECLEVEL_M), &QRcode_free);
  if (code == nullptr) throw std::runtime_error("the text is too long for a QR code");
  const float side = kCode / static_cast<float>(code->width);
  const float x = out.left() + out.width() - kCode;
  for (int i = 0; i < code->width * code->width; ++i) {
    if ((code->data[i] & 1) == 0) continue;
    out.box(x + static_cast<float>(i % code->width) * side,
            top - static_cast<float>(i / code->width + 1) * side, side);
  }
}

void write_end(Writer& out, const Certificate& certificate) {
  const float room = kCode + 5 * kTitle;
  if (out.is_full(room)) out.begin_page();
  out.advance(kText);
  const float top = out.y();
  out.paragraph(kText, certificate.summary);
  for (const std::string& line : certificate.proof) out.paragraph(kSmall, line);
  if (!certificate.code.empty()) write_code(out, certificate.code, top);
  out.advance(3 * kTitle);
  float x = out.left();
  for (const std::string& name : certificate.signatures) {
    out.text(x, out.y(), kText, std::string(38, '_'));
    out.text(x, out.y() - kText * kLeading, kSmall, name);
    x += out.width() / 3;
  }
}

std::string saved(HPDF_Doc document) {
  check(HPDF_SaveToStream(document));
  check(HPDF_ResetStream(document));
  std::string out(HPDF_GetStreamSize(document), '\0');
  HPDF_UINT32 size = static_cast<HPDF_UINT32>(out.size());
  const HPDF_STATUS status =
      HPDF_ReadFromStream(document, reinterpret_cast<HPDF_BYTE*>(out.data()), &size);
  if (status != HPDF_STREAM_EOF) check(status);
  out.resize(size);
  return out;
}

}  // namespace

std::string to_pdf(const Certificate& certificate, Paper paper) {
  const Document document(HPDF_New(nullptr, nullptr), &HPDF_Free);
  if (document == nullptr) throw std::bad_alloc();
  check(HPDF_SetCompressionMode(document.get(), HPDF_COMP_ALL));
  check(HPDF_SetInfoAttr(document.get(), HPDF_INFO_TITLE, certificate.title.c_str()));
  Writer out(document.get(), paper);
  out.paragraph(kTitle, certificate.title);
  out.advance(kText / 2);
  for (const std::string& fact : certificate.facts) out.paragraph(kText, fact);
  const Columns columns = certificate.columns.empty() ? Columns(kInspection) : certificate.columns;
  write_table_head(out, columns);
  for (const Line& line : certificate.lines) write_line(out, line, columns);
  write_end(out, certificate);
  out.number_pages(certificate.title + ", ");
  return saved(document.get());
}

}  // namespace fitgauge::certificate
