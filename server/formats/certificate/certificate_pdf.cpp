#include <qrencode.h>

#include "formats/certificate/certificate.hpp"

namespace fitgauge::certificate {
namespace {

constexpr float kMargin = 40;  // points, 1/72 inch
constexpr float kText = 8;
constexpr float kSmall = 7;
constexpr float kTitle = 16;
constexpr float kLeading = 1.35F;
constexpr float kCode = 84;
constexpr float kGap = 5;

constexpr std::array<Column, 12> kInspection = {{
    {"Part", 0.09F, &Line::part},
    {"Characteristic", 0.09F, &Line::characteristic},
    {"Size", 0.07F, &Line::size},
    {"Limits / mm", 0.107F, &Line::limits},
    {"Measured / mm", 0.078F, &Line::measured},
    {"Dev. / \u00b5m", 0.05F, &Line::deviation},
    {"In limits", 0.047F, nullptr},
    {"Verdict", 0.077F, &Line::verdict},
    {"Rule", 0.073F, &Line::rule},
    {"U / \u00b5m", 0.112F, &Line::uncertainty},
    {"Taken with, by", 0.098F, &Line::gauge},
    {"Measured at (UTC)", 0.108F, &Line::measured_at},
}};

using Code = std::unique_ptr<QRcode, decltype(&QRcode_free)>;

std::string box(float x, float y, float width, float height) {
  return fmt::format("{:.2f} {:.2f} {:.2f} {:.2f} re f\n", x, y, width, height);
}

/// Puts text on pages from the top down.
class Writer {
 public:
  Writer(const std::string& title, Paper paper)
      : width_(paper == Paper::A4 ? 841.89F : 792),
        height_(paper == Paper::A4 ? 595.28F : 612),
        pdf_(title, width_, height_),
        y_(height_ - kMargin) {}

  TaggedPdf& pdf() { return pdf_; }
  float width() const { return width_ - 2 * kMargin; }
  float left() const { return kMargin; }
  float y() const { return y_; }
  void advance(float height) { y_ -= height; }
  /// Returns whether the space above the footer is lower than this height.
  bool is_full(float height) const { return y_ - height < kMargin + 2 * kSmall; }

  void begin_page() {
    pdf_.begin_page();
    y_ = height_ - kMargin;
  }

  void element(std::string_view type, const std::string& operators, std::string more = {}) {
    pdf_.open(type, std::move(more));
    pdf_.mark(operators);
    pdf_.close();
  }

  /// A separate line. A line that is too long continues in the next one.
  void paragraph(float size, const std::string& text, std::string_view type = "P") {
    pdf_.open(type);
    for (const std::string& line : pdf_.wrapped(text, size, width() - kCode)) {
      if (is_full(size * kLeading)) begin_page();
      advance(size * kLeading);
      pdf_.mark(pdf_.text(left(), y_, size, line));
    }
    pdf_.close();
  }

  void rule(float thickness) {
    pdf_.decorate("0.6 g " + box(left(), y_, width(), thickness) + "0 g\n");
  }

 private:
  float width_;
  float height_;
  TaggedPdf pdf_;
  float y_;
};

using Columns = std::span<const Column>;

/// The tolerance in grey, half as wide as the drawing, with the value, at the end if far outside.
std::string drawing(float place, float x, float y, float width, float height) {
  const float at = x + width * (0.25F + 0.5F * std::clamp(place, -0.48F, 1.48F));
  const float tick = std::max(1.2F, width / 80);
  return "0.82 g " + box(x + width / 4, y, width / 2, height) + "0.5 g " +
         box(x, y + height / 2 - 0.2F, width, 0.4F) + "0 g " +
         box(at - tick / 2, y - height / 4, tick, height * 1.5F);
}

/// Writes the text of a verdict with its emphasis.
std::string verdict(TaggedPdf& pdf, const Line& line, float x, float y, float size,
                    const std::string& text) {
  if (line.weight == Weight::Plain) return pdf.text(x, y, size, text);
  const bool is_marked = line.weight == Weight::Marked;
  return (is_marked ? "0 g " : "0.85 g ") +
         box(x - size / 4, y - size / 4, pdf.width_of(text, size) + size / 2, size * 1.2F) +
         (is_marked ? "1 g\n" : "0 g\n") + pdf.text(x, y, size, text) + "0 g\n";
}

/// @param is_first on the first page; later ones repeat what was heard
void write_table_head(Writer& out, Columns columns, bool is_first) {
  out.advance(kText * 2);
  float x = out.left();
  if (is_first) out.pdf().open("TR");
  for (const Column& column : columns) {
    const std::string text = out.pdf().text(x, out.y(), kSmall, column.name);
    if (is_first)
      out.element("TH", text, "/A<</O/Table/Scope/Column>>");
    else
      out.pdf().decorate(text);
    x += column.share * out.width();
  }
  if (is_first) out.pdf().close();
  out.advance(kText / 2);
  out.rule(0.8F);
}

void write_line(Writer& out, const Line& line, Columns columns) {
  std::vector<std::vector<std::string>> cells;
  std::size_t most = 1;
  for (const Column& column : columns) {
    cells.emplace_back();
    if (column.text == nullptr) continue;
    cells.back() = out.pdf().wrapped(line.*column.text, kSmall, column.share * out.width() - kGap);
    most = std::max(most, cells.back().size());
  }
  const float height = static_cast<float>(most) * kSmall * kLeading + kSmall / 2;
  if (out.is_full(height)) {
    out.begin_page();
    write_table_head(out, columns, false);
  }
  float x = out.left();
  out.pdf().open("TR");
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const float width = columns[i].share * out.width();
    float y = out.y();
    std::string text;
    for (const std::string& piece : cells[i]) {
      y -= kSmall * kLeading;
      text += columns[i].text == &Line::verdict ? verdict(out.pdf(), line, x, y, kSmall, piece)
                                                : out.pdf().text(x, y, kSmall, piece);
    }
    out.pdf().open("TD");
    if (!text.empty()) out.pdf().mark(text);
    out.pdf().close();
    if (columns[i].text == nullptr && line.place)
      out.pdf().decorate(drawing(*line.place, x, y - kSmall * 1.2F, width - kGap, kSmall * 0.8F));
    x += width;
  }
  out.pdf().close();
  out.advance(height);
  out.rule(0.2F);
}

void write_code(Writer& out, const std::string& text, float top) {
  const Code code(QRcode_encodeString8bit(text.c_str(), 0, QR_ECLEVEL_M), &QRcode_free);
  if (code == nullptr) throw std::runtime_error("the text is too long for a QR code");
  const float side = kCode / static_cast<float>(code->width);
  const float x = out.left() + out.width() - kCode;
  std::string boxes;
  for (int i = 0; i < code->width * code->width; ++i) {
    if ((code->data[i] & 1) == 0) continue;
    boxes += box(x + static_cast<float>(i % code->width) * side,
                 top - static_cast<float>(i / code->width + 1) * side, side, side);
  }
  out.element("Figure", boxes, "/Alt" + TaggedPdf::string("QR code: " + text));
}

/// The logo, the address, the title and the subject of the report.
void write_head(Writer& out, const Certificate& certificate) {
  const Picture& logo = certificate.letterhead.logo;
  float y = out.y();
  for (const std::string& line : certificate.letterhead.address) {
    y -= kSmall * kLeading;
    out.element("P", out.pdf().text(out.left() + out.width() - out.pdf().width_of(line, kSmall), y,
                                    kSmall, line));
  }
  if (!logo.empty()) {
    constexpr float kWide = 160, kHigh = 40;
    const auto width = static_cast<float>(logo.width), height = static_cast<float>(logo.height);
    const float scale = std::min(kWide / width, kHigh / height);
    out.advance(height * scale);
    out.element("Figure",
                out.pdf().picture(logo, out.left(), out.y(), width * scale, height * scale),
                "/Alt(Logo)");
    out.advance(kText);
  }
  out.paragraph(kTitle, certificate.title, "H1");
  out.advance(kText / 2);
  for (const std::string& fact : certificate.facts) out.paragraph(kText, fact);
}

/// The verdict of all, and the worst value in its tolerance.
void write_summary(Writer& out, const Certificate& certificate) {
  if (certificate.summary.empty()) return;
  out.advance(kText);
  if (certificate.worst) {
    const Line& worst = *certificate.worst;
    out.advance(kTitle * 1.2F);
    out.element("P",
                verdict(out.pdf(), worst, out.left() + kTitle / 4, out.y(), kTitle, worst.verdict));
    if (worst.place) {
      constexpr float kWide = 300, kHigh = 12;
      const float x = out.left() + 180;
      out.element("Figure", drawing(*worst.place, x, out.y() + 1, kWide, kHigh),
                  "/Alt" + TaggedPdf::string(fmt::format("{} mm in its limits {} mm",
                                                         worst.measured, worst.limits)));
      const std::string limits = fmt::format("{}: {}", worst.characteristic, worst.limits);
      out.element("P", out.pdf().text(x + kWide + kText, out.y() + kText / 2, kSmall, limits));
    }
    out.advance(kText / 2);
  }
  for (const std::string& line : certificate.summary) out.paragraph(kText, line);
  out.advance(kText / 2);
  for (const std::string& line : certificate.statements) out.paragraph(kSmall, line);
}

void write_end(Writer& out, const Certificate& certificate) {
  const float room = kCode + 5 * kTitle;
  if (out.is_full(room)) out.begin_page();
  out.advance(kText);
  const float top = out.y();
  for (const std::string& line : certificate.proof) out.paragraph(kSmall, line);
  if (!certificate.code.empty()) write_code(out, certificate.code, top);
  out.advance(3 * kTitle);
  float x = out.left();
  for (const std::string& name : certificate.signatures) {
    out.pdf().decorate(box(x, out.y(), 170, 0.6F));
    out.element("P", out.pdf().text(x, out.y() - kText * kLeading, kSmall, name));
    x += (out.width() - kCode) / 3;
  }
}

}  // namespace

Result<Letterhead> read_letterhead(std::string_view address, const std::string& logo) {
  Letterhead letterhead;
  while (!address.empty()) letterhead.address.emplace_back(trim(take_field(address, ';')));
  if (logo.empty()) return letterhead;
  letterhead.logo = TRY(read_picture(logo));
  return letterhead;
}

std::string to_pdf(const Certificate& certificate, Paper paper) {
  Writer out(certificate.title, paper);
  write_head(out, certificate);
  write_summary(out, certificate);
  const Columns columns = certificate.columns.empty() ? Columns(kInspection) : certificate.columns;
  out.pdf().open("Table");
  write_table_head(out, columns, true);
  for (const Line& line : certificate.lines) write_line(out, line, columns);
  out.pdf().close();
  write_end(out, certificate);
  return out.pdf().finish([&](std::size_t page, std::size_t of) {
    const std::string line = fmt::format("{}, page {} of {}", certificate.title, page, of);
    return out.pdf().text(out.left() + out.width() - out.pdf().width_of(line, kSmall),
                          kMargin - kSmall, kSmall, line);
  });
}

}  // namespace fitgauge::certificate
