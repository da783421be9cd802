#pragma once

#include "formats/dfq/measurement_csv.hpp"

struct XML_ParserStruct;

namespace fitgauge::qif {

/// Names and texts.
using Attributes = std::vector<std::pair<std::string, std::string>>;

/// An element with its children. A view: valid until its reader continues.
class Element {
 public:
  /// An element and all below it, in the order of the document.
  struct Tree {
    struct Node {
      std::string name;
      Attributes attributes{};  ///< those without a namespace
      std::size_t text_begin = 0;
      std::size_t text_end = 0;  ///< with that of all below
      std::size_t next = 0;      ///< the place after all nested elements
    };

    std::vector<Node> nodes{};
    std::string text{};  ///< of all nodes
  };
  Element(const Tree& tree, std::size_t place) : tree_(&tree), place_(place) {}

  const std::string& name() const;
  /// An attribute of the element, without surrounding blanks; empty if it has none.
  std::string attribute(std::string_view name) const;
  /// Trimmed text of the first element at the path `Tolerance/MaxValue` below; empty if absent.
  std::string text(std::string_view path) const {
    const auto found = find(path);
    return found.empty() ? std::string() : found.front().own_text();
  }
  /// Its text without surrounding blanks.
  std::string own_text() const;
  bool has(std::string_view path) const { return !find(path).empty(); }
  /// All elements at the path.
  std::vector<Element> find(std::string_view path) const {
    std::vector<Element> found;
    find(path, found);
    return found;
  }
  /// Returns names and values of AttributeStr and the other elements in `Attributes`, unchanged.
  Attributes named_attributes() const;

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
  /// All of the element, which next() then passes over; name(), parent() and depth() say
  /// nothing until then. @errors CsvMalformed with the line
  Result<Element> take();

 private:
  static constexpr std::size_t kNothing = std::numeric_limits<std::size_t>::max();

  // The parser calls these. It pauses at the begin of an element, and at the end of a taken one.
  void begin(std::string_view name, const char** attributes);
  void add(std::string_view text);
  void end();
  void fail(std::string what);

  int feed();  ///< @returns an XML_Status
  std::uint32_t line_now() const;
  void check_size();
  /// Ends the innermost node that is open.
  void close();
  void leave() {
    names_.pop_back();
    if (names_.size() < passed_) passed_ = kNothing;
  }

  Read read_;
  std::unique_ptr<XML_ParserStruct, void (*)(XML_ParserStruct*)> parser_;
  std::uint64_t fed_ = 0;
  bool is_over_ = false;  ///< the parser has the whole document
  std::optional<Error> error_{};
  std::vector<std::string> names_{};  ///< of the elements from the outermost on
  std::string name_space_{};
  std::uint32_t line_ = 1;
  std::uint64_t begin_ = 0;        ///< byte of the element where the reader is
  bool has_ended_ = false;         ///< that element, which is empty
  std::size_t passed_ = kNothing;  ///< the depth below which elements are passed over
  std::unique_ptr<Element::Tree> tree_ = std::make_unique<Element::Tree>();  ///< of that element
  std::vector<std::size_t> open_{};  ///< places of the nodes that are being taken
};

/// The texts of a measurement by the places of sheet::kMeasurementFields.
using Fields = std::array<std::string, sheet::kMeasurementFields.size()>;

/// Sets the field of that name; other names are ignored.
void set_field(Fields& fields, std::string_view name, std::string_view text);

/// The characteristics, parts and devices of a document. Bounded in memory.
class Definitions {
 public:
  /// A characteristic that was measured.
  struct Item {
    std::string name{};
    std::string nominal{};       ///< id
    std::string device{};        ///< id
    std::string part_feature{};  ///< id of a feature item
    Attributes attributes{};     ///< by names of fields
  };
  struct Nominal {
    std::string definition{};  ///< id
    std::string target{};
    std::string name{};
    std::string feature{};  ///< id of a feature's nominal
  };
  struct Definition {
    std::string upper{};
    std::string lower{};
    bool is_limit = false;  ///< else they are deviations
    std::string class_name{};
    std::string feature{};
    std::string quantity{};
    std::string size_operator{};
    std::string envelope{};
    std::string name{};
  };

  /// Reads all but the measurements. @errors CsvMalformed with the line
  static Result<Definitions> read(Read document, std::optional<sheet::LengthUnit> fallback);

  /// Returns null if there is no such id.
  const Item* item(const std::string& id) const { return find(items_, id); }
  const Nominal* nominal(const std::string& id) const { return find(nominals_, id); }
  const Definition* definition(const std::string& id) const { return find(definitions_, id); }
  std::string_view part(const std::string& id) const { return text(parts_, id); }
  std::string_view device(const std::string& id) const { return text(devices_, id); }
  /// Returns `hole`, `shaft` or nothing, for the feature of a characteristic.
  std::string_view feature(const Item& item, const Nominal& nominal) const {
    std::string of_nominal = nominal.feature;
    if (of_nominal.empty()) of_nominal = text(feature_items_, item.part_feature);
    return text(features_, std::string(text(feature_nominals_, of_nominal)));
  }
  /// Returns the unit of the document or of the caller; none if neither has one.
  std::optional<sheet::LengthUnit> unit() const { return unit_; }
  const std::string& unit_name() const { return unit_name_; }
  const std::string& order() const { return order_; }
  const std::string& inspector() const { return inspector_; }

 private:
  template <class Value>
  using ById = std::map<std::string, Value, std::less<>>;
  template <class Value>
  static const Value* find(const ById<Value>& by_id, const std::string& id) {
    const auto found = by_id.find(id);
    return found == by_id.end() ? nullptr : &found->second;
  }
  static std::string_view text(const ById<std::string>& by_id, const std::string& id) {
    const auto* const found = find(by_id, id);
    return found == nullptr ? std::string_view() : std::string_view(*found);
  }
  /// Reads an element of one of the lists. Stores only the used parts.
  void take(std::string_view list, const Element& element);

  ById<Item> items_{};
  ById<Nominal> nominals_{};
  ById<Definition> definitions_{};
  ById<std::string> parts_{};
  ById<std::string> devices_{};
  ById<std::string> features_{};          ///< hole or shaft
  ById<std::string> feature_nominals_{};  ///< id of the feature's definition
  ById<std::string> feature_items_{};     ///< id of the feature's nominal
  std::optional<sheet::LengthUnit> unit_{};
  std::string unit_name_{};
  std::string order_{};
  std::string inspector_{};
};

/// As for a DFQ, without columns; others are characteristics that are no size, or have no value.
struct QifOptions : aqdef::MeasurementOptions {
  std::size_t most_rows = 100'000;
};

/// Whether a file name ends with `.qif`.
bool is_qif(std::string_view file_name);

/// Reads the sizes that a QIF 3 document has measured: diameters, widths, lengths, thicknesses and
/// such, with the tolerance of their characteristic, which must not contradict its class. An
/// attribute by the name of a field of /v1/measurements is that field. The document is read twice,
/// element by element, in a bounded piece of memory. Of no more use after an error.
class QifRows {
 public:
  /// @param first, again two readers of one document: `first` is read first, then `again`
  /// @errors CsvMalformed with the line
  static Result<QifRows> open(Read first, Read again, QifOptions options) {
    auto definitions = TRY(Definitions::read(std::move(first), options.length_unit));
    return QifRows(std::move(definitions), std::move(again), std::move(options));
  }
  std::string header() const;
  /// Appends the row of the next measurement, and the line of the document for each of its lines.
  /// @returns false at the end. @errors CsvMalformed with the line
  Result<bool> append(std::string& rows, std::vector<std::uint32_t>& lines);
  /// Checks after the last value. @errors CsvMalformed: there was no value.
  Result<void> check() const {
    if (rows_ > 0) return {};
    return Error{aqdef::kMalformed, "the document has no measured size"};
  }

 private:
  QifRows(Definitions definitions, Read document, QifOptions options)
      : definitions_(std::move(definitions)),
        options_(std::move(options)),
        reader_(std::move(document)) {}

  /// @returns whether there is a row.
  Result<bool> read_row(const Element& element, std::uint32_t line);
  /// Returns why it is not a measurement; empty if it is one.
  std::string reason_against(const Element& element, const Definitions::Item& item) const;
  /// @pre reason_against() found none
  Result<void> read_tolerance(const Definitions::Item& item, std::uint32_t line);
  Result<void> read_value(const Element& element, std::uint32_t line);
  Result<void> read_time(const Element& element, std::uint32_t line);
  Result<Length> length(std::string_view what, const std::string& text, std::uint32_t line) const;
  Result<std::optional<Length>> limit(const std::string& text, Length from, std::string_view what,
                                      std::uint32_t line) const {
    if (text.empty()) return std::optional<Length>();
    const auto read = TRY(length(what, text, line));
    return std::optional(from + read);
  }
  /// If nothing more specific is known.
  void fill(std::size_t place, std::string_view text) {
    if (fields_.at(place).empty()) fields_.at(place) = text;
  }

  Definitions definitions_;
  QifOptions options_;
  XmlReader reader_;
  Fields fields_{};
  std::size_t rows_ = 0;
};

/// Makes a QIF document of results: the characteristics with their limits, the measurements in
/// their order, and their parts. Fields without a place in QIF become attributes with their name.
/// Equal measurements give equal bytes. Not thread-safe.
class QifWriter {
 public:
  /// @errors FieldInvalid: a text has a character that XML does not allow, or the measurement is
  /// simulated; nothing is added.
  Result<void> add(const app::Measurement& measurement);
  bool is_empty() const { return measurements_ == 0; }
  /// Returns the element QIFDocument, the begin of the document. @pre !is_empty()
  std::string element() const;
  /// The whole file.
  std::string text() const {
    std::string out = element();
    out.insert(0, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    return out;
  }

 private:
  struct Part {
    std::uint32_t id = 0;
    std::size_t worst = 0;  ///< status of its values, as worst_
  };

  /// Returns the item of a characteristic, and makes it at the first call.
  std::uint32_t item_of(const app::Measurement& m);

  std::string qpid_{};
  std::uint32_t last_id_ = 1;  ///< 1 is the standard
  bool is_iso286_ = true;      ///< all limits are
  std::size_t measurements_ = 0;
  std::size_t worst_ = 0;  ///< place in the list of statuses, from the best on
  std::map<std::string, std::uint32_t, std::less<>> items_{};  ///< by their definition and name
  std::map<std::string, Part, std::less<>> parts_{};
  std::string definitions_{};
  std::string nominals_{};
  std::string item_texts_{};
  std::string measurement_texts_{};
};

}  // namespace fitgauge::qif
