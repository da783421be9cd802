#include "record/record.hpp"

#include <cassert>

#include "base/json/json_writer.hpp"
#include "record/record_members.hpp"

namespace fitgauge::app {
namespace {

/// Writes at the end of a string into reserved room, so that a piece costs only its bytes: for tens
/// of thousands of records. Other code uses api::JsonWriter.
class RecordText {
 public:
  /// @param room no fewer characters than will be written.
  RecordText(std::string& out, std::size_t room) : out_(out), at_(extend(out, room)) {}
  RecordText& operator=(RecordText&&) = delete;  // neither copied nor moved
  /// Returns the unused room.
  ~RecordText() {
    assert(size() <= out_.size());
    out_.resize(size());
  }

  /// Returns the present length of the string.
  std::size_t size() const { return static_cast<std::size_t>(at_ - out_.data()); }
  /// The text from `begin`.
  std::string_view from(std::size_t begin) const { return {out_.data() + begin, size() - begin}; }

  RecordText& raw(std::string_view text) {
    at_ = std::copy(text.begin(), text.end(), at_);
    return *this;
  }
  RecordText& decimal(std::int64_t value, int scale) {
    at_ = write_decimal(at_, value, scale);
    return *this;
  }
  /// A value in 1e-9, below 1e-6 with an exponent as RFC 8785 wants it.
  RecordText& billionths(std::int64_t value) {
    if (value <= 0 || value >= 1000) return decimal(value, 9);
    const int digits = value < 10 ? 1 : value < 100 ? 2 : 3;
    const char exponent = static_cast<char>('0' + 10 - digits);
    return decimal(value, digits - 1).raw("e-").raw({&exponent, 1});
  }
  RecordText& mm(Length length) { return decimal(length.count(), 6); }
  RecordText& um(Length length) { return decimal(length.count(), 3); }
  RecordText& time(Timestamp time) {
    at_ = write_rfc3339(at_, time);
    return *this;
  }
  /// The inside of a JSON string: at most kEscaped characters for each of the text.
  RecordText& escaped(std::string_view text);
  /// Writes an escaped text between quotes.
  RecordText& quoted(std::string_view text) { return raw("\"").escaped(text).raw("\""); }

  static constexpr std::size_t kEscaped = kEscapeRoom;

 private:
  static char* extend(std::string& out, std::size_t room) {
    const std::size_t size = out.size();
    out.resize(size + room);
    return out.data() + size;
  }

  std::string& out_;
  char* at_;
};

RecordText& RecordText::escaped(std::string_view text) {
  char* at = at_;
  for (const char c : text) {
    if (needs_escape(c)) {
      at = write_escape(at, c);
    } else {
      *at++ = c;
    }
  }
  at_ = at;
  return *this;
}

/// Room for the names of all members and their numbers, times, words and ids.
constexpr std::size_t kFixedRoom = [] {
  constexpr std::size_t kNumber = 28;  // with `,"":` around the name
  std::size_t room = 256;              // for ids, times and the size range, which are longer
  for (const std::string_view name : members::kNames) room += name.size() + kNumber;
  return room;
}();

std::size_t room_for(const Measurement& m) {
  std::size_t texts = m.table_revision.size() + 2 * m.class_name.value_or("").size();
  for_each_plain([&](const MeasurementField& /*field*/, auto member) {
    if constexpr (std::is_same_v<decltype(member), MeasurementField::Text>) {
      texts += (m.*member).value_or("").size();
    }
  });
  return kFixedRoom + RecordText::kEscaped * texts;
}

bool same_times(const Measurement& a, const Measurement& b) {
  return a.measured_at == b.measured_at && a.received_at == b.received_at;
}

bool same_limits(const Measurement& a, const Measurement& b) {
  const auto limits = [](const Measurement& m) {
    return std::tie(m.nominal_size, m.class_name, m.deviations, m.size_range, m.basis);
  };
  return limits(a) == limits(b);
}

/// Writes a member of a record after the previous ones; nothing without a value.
class MemberText {
 public:
  MemberText(RecordText& text, std::string_view name) : text_(text), name_(name) {}

  void word(std::string_view word) { begin().raw("\"").raw(word).raw("\""); }
  void name(std::string_view text) { begin().quoted(text); }
  void text(std::string_view text) { begin().quoted(text); }
  void time(Timestamp time) { begin().raw("\"").time(time).raw("\""); }
  void mm(Length length) { begin().mm(length); }
  void um(Length length) { begin().um(length); }
  void decimal(std::int64_t value, int scale) { begin().decimal(value, scale); }
  void billionths(std::int64_t value) { begin().billionths(value); }
  void truth() { begin().raw("true"); }
  void null() { begin().raw("null"); }

  void designation(const Measurement& m) {
    if (!m.class_name) return;
    if (m.basis == LimitsBasis::Standard) {
      std::string designation;
      standards::append_designation(designation, m.nominal_size, *m.class_name);
      return text(designation);
    }
    begin().raw("\"").mm(m.nominal_size).raw(" ").escaped(*m.class_name).raw("\"");
  }
  void size_range(const Measurement& m) {
    if (!m.size_range) return;
    begin().raw(R"({"over":)").mm(m.size_range->over);
    text_.raw(R"(,"up_to":)").mm(m.size_range->up_to).raw("}");
  }

 private:
  RecordText& begin() { return text_.raw(",\"").raw(name_).raw("\":"); }

  RecordText& text_;
  std::string_view name_;
};

}  // namespace

// Flattened: a call for each member costs a tenth.
[[gnu::flatten]] void RecordWriter::append(const Measurement& m) {
  static_assert(members::kNames.size() <= kMostMembers);
  const bool times = before_ != nullptr && same_times(*before_, m);
  const bool limits = before_ != nullptr && same_limits(*before_, m);
  before_ = &m;
  RecordText text(out_, room_for(m));
  const std::size_t begin = text.size();
  for_each_member([&](const auto& member, std::size_t index) {
    const std::size_t at = text.size();
    if (member.shared == SharedPart::None) {
      MemberText to(text, member.name);
      return member.write(m, MemberValue{to});
    }
    Place& place = parts_.at(index);
    if (member.shared == SharedPart::Times ? times : limits) {
      text.raw(std::string_view(out_).substr(place.at, place.size));
    } else {
      MemberText to(text, member.name);
      member.write(m, MemberValue{to});
    }
    place = {.at = at, .size = text.size() - at};
  });
  out_[begin] = '{';  // instead of a comma
  text.raw("}");
}

void append_record(std::string& out, const Measurement& measurement) {
  RecordWriter(out).append(measurement);
}

}  // namespace fitgauge::app
