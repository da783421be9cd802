#include "formats/certificate/tagged_pdf.hpp"

#include <zlib.h>

#include "base/folder.hpp"

namespace fitgauge::certificate {
namespace {

// The first objects of each document:
constexpr std::size_t kCatalog = 1, kPages = 2, kResources = 3, kFont = 4, kTree = 5;

std::string deflated(std::string_view bytes) {
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(out.data()), &size,
                reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(),
                Z_DEFAULT_COMPRESSION) != Z_OK) {
    throw std::bad_alloc();
  }
  out.resize(size);
  return out;
}

void append_utf16(std::string& out, char32_t character) {
  if (character < 0x10000) {
    fmt::format_to(std::back_inserter(out), "{:04X}", static_cast<std::uint32_t>(character));
  } else {
    const auto rest = static_cast<std::uint32_t>(character) - 0x10000;
    fmt::format_to(std::back_inserter(out), "{:04X}{:04X}", 0xD800 + (rest >> 10),
                   0xDC00 + (rest & 0x3FF));
  }
}

}  // namespace

Result<Picture> read_picture(const std::string& path) {
  constexpr std::size_t kMostBytes = std::size_t{1} << 20, kHead = 33;
  constexpr std::uint32_t kMostPixels = 2000;
  const auto refused = [&](std::string_view why) {
    return Error{ErrorCode::ConfigInvalid, fmt::format("the picture {} {}", path, why)};
  };
  const auto read = read_regular(path);
  if (!read) return refused("cannot be read: name a PNG file that the service may read");
  const std::string& file = *read;
  const auto number = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = at; i < at + 4; ++i)
      value = value << 8 | static_cast<unsigned char>(file[i]);
    return value;
  };
  if (file.size() < kHead || !file.starts_with("\x89PNG\r\n\x1A\n"))
    return refused("must be a PNG file");
  Picture picture{.width = number(16), .height = number(20), .colours = file[25] == 0 ? 1 : 3};
  if (file.size() > kMostBytes || picture.width > kMostPixels || picture.height > kMostPixels)
    return refused("must have at most 1 MiB and 2000 x 2000 pixels: save it smaller");
  if (file[24] != 8 || (file[25] != 0 && file[25] != 2) || file[28] != 0) {
    return refused(
        "must be grey or RGB with 8 bits, neither transparent nor interlaced: save it again");
  }
  for (std::size_t at = kHead; at + 12 <= file.size(); at += std::size_t{12} + number(at)) {
    if (file.compare(at + 4, 4, "IDAT") == 0) picture.packed.append(file, at + 8, number(at));
  }
  std::string rows(
      picture.height * (std::size_t{1} + picture.width * static_cast<unsigned>(picture.colours)),
      '\0');
  uLongf size = rows.size();
  const int done =
      uncompress(reinterpret_cast<Bytef*>(rows.data()), &size,
                 reinterpret_cast<const Bytef*>(picture.packed.data()), picture.packed.size());
  if (done != Z_OK || size != rows.size() || picture.width == 0)
    return refused("is damaged: save it again");
  return picture;
}

TaggedPdf::TaggedPdf(std::string_view title, float width, float height)
    : out_("%PDF-1.7\n%\xE2\xE3\xCF\xD3\n"),
      title_(title),
      box_(fmt::format("[0 0 {} {}]", width, height)) {
  while (reserve() < kTree) {
  }
  begin_page();
  open("Document");
}

void TaggedPdf::put(std::size_t number, std::string_view object) {
  constexpr std::size_t kTogether = 200;
  places_[number] = {2, 0, static_cast<std::uint16_t>(waiting_.size())};
  waiting_.push_back(number);
  fmt::format_to(std::back_inserter(heads_), "{} {} ", number, bodies_.size());
  bodies_.append(object) += '\n';
  if (waiting_.size() == kTogether) flush();
}

void TaggedPdf::put_stream(std::size_t number, const std::string& entries, std::string_view bytes,
                           bool is_packed) {
  const std::string packed(is_packed ? std::string(bytes) : deflated(bytes));
  places_[number] = {1, static_cast<std::uint32_t>(out_.size()), 0};
  out_ += fmt::format("{} 0 obj\n<<{}/Filter/FlateDecode/Length {}>>stream\n", number, entries,
                      packed.size());
  out_.append(packed).append("\nendstream\nendobj\n");
}

/// Packs the objects that wait into a stream of objects (ISO 32000-1, 7.5.7).
void TaggedPdf::flush() {
  const std::size_t stream = reserve();
  for (const std::size_t number : waiting_) places_[number].at = static_cast<std::uint32_t>(stream);
  put_stream(stream, fmt::format("/Type/ObjStm/N {}/First {}", waiting_.size(), heads_.size()),
             heads_ + bodies_);
  heads_.clear();
  bodies_.clear();
  waiting_.clear();
}

void TaggedPdf::end_page() {
  const Page& page = pages_.back();
  const std::size_t content = reserve();
  put_stream(content, "", content_);
  put(page.page, fmt::format("<</Type/Page/Parent {} 0 R/MediaBox{}/Resources {} 0 "
                             "R/Tabs/S/StructParents {}/Contents[{} 0 R {} 0 R]>>",
                             kPages, box_, kResources, pages_.size() - 1, content, page.footer));
  put(page.parents, "[" + parents_ + "]");
  content_.clear();
  parents_.clear();
  marks_ = 0;
}

void TaggedPdf::close() {
  const Element element = std::move(open_.back());
  open_.pop_back();
  put(element.number, fmt::format("<</S/{}/P {} 0 R/Pg {} 0 R{}/K[{}]>>", element.type,
                                  open_.empty() ? kTree : open_.back().number, element.page,
                                  element.more, element.kids));
  if (!open_.empty()) open_.back().kids += fmt::format("{} 0 R ", element.number);
}

void TaggedPdf::mark(const std::string& operators) {
  Element& element = open_.back();
  const std::size_t page = pages_.back().page;
  element.kids += page == element.page
                      ? fmt::format("{} ", marks_)
                      : fmt::format("<</Type/MCR/Pg {} 0 R/MCID {}>>", page, marks_);
  parents_ += fmt::format("{} 0 R ", element.number);
  content_ += fmt::format("/{} <</MCID {}>> BDC\n{}EMC\n", element.type, marks_++, operators);
}

std::string TaggedPdf::text(float x, float y, float size, std::string_view line) {
  std::string out = fmt::format("BT /F {} Tf {:.2f} {:.2f} Td <", size, x, y);
  while (!line.empty()) {
    const std::uint16_t code = font_.code(take_character(line));
    for (int shift = 12; shift >= 0; shift -= 4) out += "0123456789ABCDEF"[code >> shift & 15];
  }
  return out += "> Tj ET\n";
}

std::vector<std::string> TaggedPdf::wrapped(std::string_view text, float size, float room) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    std::size_t end = 0;    // of what fits
    std::size_t blank = 0;  // after its last blank
    std::size_t width = 0;
    for (std::string_view rest = text; !rest.empty();) {
      const char32_t character = take_character(rest);
      const std::size_t at = text.size() - rest.size();
      width += font_.width(character);
      if (character == ' ')
        blank = at;
      else if (end > 0 && static_cast<float>(width) * size / 1000 > room)
        break;
      end = at;
    }
    if (end < text.size() && blank > 0) end = blank;
    lines.emplace_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  return lines;
}

std::string TaggedPdf::picture(const Picture& picture, float x, float y, float width,
                               float height) {
  picture_ = reserve();
  put_stream(
      picture_,
      fmt::format("/Type/XObject/Subtype/Image/Width {0}/Height {1}/BitsPerComponent "
                  "8/ColorSpace/Device{2}/DecodeParms<</Predictor 15/Colors {3}/Columns {0}>>",
                  picture.width, picture.height, picture.colours == 1 ? "Gray" : "RGB",
                  picture.colours),
      picture.packed, true);
  return fmt::format("q {:.2f} 0 0 {:.2f} {:.2f} {:.2f} cm /I Do Q\n", width, height, x, y);
}

std::string TaggedPdf::string(std::string_view text) {
  std::string out = "<FEFF";
  while (!text.empty()) append_utf16(out, take_character(text));
  return out += '>';
}

/// The font, which glyph is which code, and which character it is when it is copied.
void TaggedPdf::put_font() {
  std::string widths;
  std::string glyphs;
  std::string characters;
  for (std::size_t code = 0; code < font_.used().size(); ++code) {
    const EmbeddedFont::Used& used = font_.used()[code];
    widths += fmt::format("{} ", used.width);
    glyphs += {static_cast<char>(used.glyph >> 8), static_cast<char>(used.glyph & 0xFF)};
    if (code % 100 == 0) {
      characters += fmt::format("{}{} beginbfchar\n", code == 0 ? "" : "endbfchar\n",
                                std::min<std::size_t>(100, font_.used().size() - code));
    }
    fmt::format_to(std::back_inserter(characters), "<{:04X}> <", code);
    append_utf16(characters, used.character);
    characters += ">\n";
  }
  const std::size_t file = reserve(), map = reserve(), meaning = reserve(), descriptor = reserve(),
                    part = reserve();
  const std::string bytes = font_.file();
  put_stream(file, fmt::format("/Length1 {}", bytes.size()), bytes);
  put_stream(map, "", glyphs);
  put_stream(
      meaning, "",
      "/CIDInit /ProcSet findresource begin 12 dict begin begincmap /CIDSystemInfo <</Registry "
      "(Adobe) /Ordering (UCS) /Supplement 0>> def /CMapName /Adobe-Identity-UCS def /CMapType 2 "
      "def\n1 begincodespacerange <0000> <FFFF> endcodespacerange\n" +
          characters +
          "endbfchar\nendcmap CMapName currentdict /CMap defineresource pop end end\n");
  put(descriptor,
      fmt::format(
          "<</Type/FontDescriptor/FontName/FITGAU+DejaVuSans/Flags 4/FontBBox[-1021 -463 1793 "
          "1232]/ItalicAngle 0/Ascent 928/Descent -236/CapHeight 729/StemV 90/FontFile2 {} 0 R>>",
          file));
  put(part, fmt::format("<</Type/Font/Subtype/CIDFontType2/BaseFont/FITGAU+DejaVuSans/"
                        "CIDSystemInfo<</Registry(Adobe)/Ordering(Identity)/Supplement "
                        "0>>/FontDescriptor {} 0 R/CIDToGIDMap {} 0 R/W[0[{}]]>>",
                        descriptor, map, widths));
  put(kFont, fmt::format("<</Type/Font/Subtype/Type0/BaseFont/FITGAU+DejaVuSans/Encoding/"
                         "Identity-H/DescendantFonts[{} 0 R]/ToUnicode {} 0 R>>",
                         part, meaning));
}

std::string TaggedPdf::finish(const std::function<std::string(std::size_t, std::size_t)>& footer) {
  end_page();
  const std::size_t document = open_.back().number;
  close();
  std::string kids;
  std::string parents;
  for (std::size_t i = 0; i < pages_.size(); ++i) {
    kids += fmt::format("{} 0 R ", pages_[i].page);
    parents += fmt::format("{} {} 0 R ", i, pages_[i].parents);
    put_stream(pages_[i].footer, "",
               "/Artifact <</Type/Pagination>> BDC\n" + footer(i + 1, pages_.size()) + "EMC\n");
  }
  put_font();
  put(kCatalog,
      fmt::format("<</Type/Catalog/Pages {} 0 R/StructTreeRoot {} 0 R/Lang(en)/MarkInfo<</Marked "
                  "true>>/ViewerPreferences<</DisplayDocTitle true>>>>",
                  kPages, kTree));
  put(kPages, fmt::format("<</Type/Pages/Count {}/Kids[{}]>>", pages_.size(), kids));
  put(kResources, fmt::format("<</Font<</F {} 0 R>>{}>>", kFont,
                              picture_ == 0 ? "" : fmt::format("/XObject<</I {} 0 R>>", picture_)));
  put(kTree,
      fmt::format("<</Type/StructTreeRoot/K {} 0 R/ParentTree<</Nums[{}]>>/ParentTreeNextKey {}>>",
                  document, parents, pages_.size()));
  const std::size_t info = reserve();
  put(info, fmt::format("<</Title{}/Producer(fitgauge)>>", string(title_)));
  flush();
  const std::size_t index = reserve();
  places_[index] = {1, static_cast<std::uint32_t>(out_.size()), 0};
  std::string rows;
  for (const Place& place : places_) {
    rows += static_cast<char>(place.kind);
    for (int shift = 24; shift >= 0; shift -= 8)
      rows += static_cast<char>(place.at >> shift & 0xFF);
    rows += {static_cast<char>(place.index >> 8), static_cast<char>(place.index & 0xFF)};
  }
  const std::size_t start = out_.size();
  put_stream(index,
             fmt::format("/Type/XRef/Size {}/W[1 4 2]/Root {} 0 R/Info {} 0 R", places_.size(),
                         kCatalog, info),
             rows);
  out_ += fmt::format("startxref\n{}\n%%EOF\n", start);
  return std::move(out_);
}

}  // namespace fitgauge::certificate
