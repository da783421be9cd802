#pragma once

#include "record/measurement.hpp"

namespace fitgauge::app {

/// Parts that the records of one request mostly share.
enum class SharedPart : std::uint8_t { None, Times, Limits };

/// A member of a record, mostly a column of tables too. `write(measurement, to)` calls the function
/// of MemberValue for its kind of value.
template <class Write>
struct RecordMember {
  std::string_view name;
  int place = 0;  ///< as MeasurementField::place; 0: in no table
  Write write;
  SharedPart shared = SharedPart::None;
};
template <class Write>
RecordMember(std::string_view, int, Write, SharedPart = SharedPart::None) -> RecordMember<Write>;

/// Passes a value, if there is one, to the function for its kind. `word` needs no escape, `name`
/// may need one, `text` is chosen by somebody. A member that is in no table may also be a
/// designation or a size range.
template <class Out>
struct MemberValue {
  Out& out;

  void word(std::string_view text) { text.empty() ? void() : out.word(text); }
  void name(std::string_view text) { text.empty() ? void() : out.name(text); }
  void text(std::optional<std::string_view> text) { text ? out.text(*text) : void(); }
  void time(Timestamp time) { out.time(time); }
  void mm(std::optional<Length> length) { length ? out.mm(*length) : void(); }
  void um(std::optional<Length> length) { length ? out.um(*length) : void(); }
  void decimal(std::optional<std::int64_t> value, int scale) {
    value ? out.decimal(*value, scale) : void();
  }
  void billionths(std::optional<std::int64_t> value) { value ? out.billionths(*value) : void(); }
  void truth(bool value) { value ? out.truth() : void(); }
  void null() { out.null(); }
};
template <class Out>
MemberValue(Out&) -> MemberValue<Out>;

namespace members {

using M = const Measurement&;
constexpr SharedPart kTimes = SharedPart::Times;
constexpr SharedPart kLimits = SharedPart::Limits;

template <class T>
constexpr std::optional<T> if_so(bool there, T value) {
  return there ? std::optional<T>(value) : std::nullopt;
}
inline std::optional<std::int64_t> figure(M m, std::int64_t gauging::ConformanceFigures::*of) {
  return m.conformance ? std::optional((*m.conformance).*of) : std::nullopt;
}

/// The envelope that is required: as the GO gauge found it.
inline std::string_view envelope_result(M m) {
  if (!m.envelope) return "";
  if (!m.go_gauge) return "not_verified";
  return m.has_failed_envelope() ? "failed" : "verified";
}

/// The members in one object: of std::tuple, GCC takes three seconds for as many.
template <std::size_t I, class Member>
struct Numbered {
  Member member;
};
template <class Numbers, class... Member>
struct List;
template <std::size_t... I, class... Member>
struct List<std::index_sequence<I...>, Member...> : Numbered<I, Member>... {
  static constexpr std::size_t kCount = sizeof...(I);
};
template <std::size_t I, class Member>
constexpr const Member& at(const Numbered<I, Member>& one) {
  return one.member;
}
template <class... Member>
constexpr auto list_of(Member... member) {
  return List<std::index_sequence_for<Member...>, Member...>{{member}...};
}

template <std::size_t I>
constexpr auto plain_member() {
  return RecordMember{kMeasurementFields[I].name, kMeasurementFields[I].place, [](M m, auto to) {
                        if constexpr (kMeasurementFields[I].text != nullptr) {
                          to.text(m.*kMeasurementFields[I].text);
                        } else if constexpr (kMeasurementFields[I].accepted.is_truth) {
                          to.truth((m.*kMeasurementFields[I].number).has_value());
                        } else {
                          to.decimal(m.*kMeasurementFields[I].number, kMeasurementFields[I].scale);
                        }
                      }};
}

/// Those that are computed from several MeasurementFields, and the others.
inline constexpr auto kAll = []<std::size_t... I>(std::index_sequence<I...>) {
  return list_of(
      RecordMember{"basis", 12, [](M m, auto to) { to.word(word(m.basis)); }},
      RecordMember{"calibration_overdue", 48,
                   [](M m, auto to) { to.truth(m.calibration_due.has_value()); }},
      RecordMember{"conflict", 0, [](M m, auto to) { to.truth(m.conflict); }},
      RecordMember{"conformance_probability", 38,
                   [](M m, auto to) {
                     to.billionths(figure(m, &gauging::ConformanceFigures::probability));
                   }},
      RecordMember{"corrected_by", 0, [](M m, auto to) { to.word(corrector_id_text(m)); }},
      RecordMember{"corrected_mm", 40, [](M m, auto to) { to.mm(m.corrected); }},
      RecordMember{"correction_of", 35,
                   [](M m, auto to) { to.word(m.correction_of ? corrected_id_text(m) : ""); }},
      RecordMember{"coverage_factor", 20,
                   [](M m, auto to) {
                     if (m.coverage_factor) to.decimal(m.coverage_factor->millionths(), 6);
                   }},
      RecordMember{"designation", 0, [](M m, auto to) { to.out.designation(m); }, kLimits},
      RecordMember{
          "deviation_um", 15,
          [](M m, auto to) { to.um(if_so(m.has_nominal(), m.decisive() - m.nominal_size)); }},
      RecordMember{"envelope_result", 60, [](M m, auto to) { to.word(envelope_result(m)); }},
      RecordMember{"excess_um", 17,
                   [](M m, auto to) { to.um(if_so(m.is_judged(), m.result.excess)); }},
      RecordMember{"feature", 7,
                   [](M m, auto to) { to.word(m.has_feature() ? word(m.feature) : ""); }},
      RecordMember{"form_um", 64,
                   [](M m, auto to) {
                     if (m.form) return to.um(Length::nanometres(*m.form));
                     if (m.points) to.null();
                   }},
      RecordMember{
          "guard_band_um", 39,
          [](M m, auto to) { to.billionths(figure(m, &gauging::ConformanceFigures::guard_band)); }},
      RecordMember{"id", 1, [](M m, auto to) { to.word(measurement_id_text(m.id, m.origin)); }},
      RecordMember{"lower_deviation_um", 9,
                   [](M m, auto to) { to.um(if_so(m.has_lower_limit(), m.deviations.lower)); },
                   kLimits},
      RecordMember{"lower_limit_mm", 11,
                   [](M m, auto to) { to.mm(if_so(m.has_lower_limit(), m.lower_limit())); },
                   kLimits},
      RecordMember{"measured_at", 3, [](M m, auto to) { to.time(m.measured_at); }, kTimes},
      RecordMember{"measured_mm", 14, [](M m, auto to) { to.mm(m.measured); }},
      RecordMember{"nominal_mm", 5,
                   [](M m, auto to) { to.mm(if_so(m.has_nominal(), m.nominal_size)); }, kLimits},
      RecordMember{"probability", 37,
                   [](M m, auto to) {
                     if (m.conformance) to.decimal(m.rule.probability().millionths(), 6);
                   }},
      RecordMember{"quantity", 55,
                   [](M m, auto to) { to.word(m.quantity ? word(*m.quantity) : ""); }},
      RecordMember{"received_at", 4, [](M m, auto to) { to.time(m.received_at); }, kTimes},
      RecordMember{"rule", 18,
                   [](M m, auto to) { to.word(m.is_judged() ? word(m.rule.kind()) : ""); }},
      RecordMember{"run_id", 33,
                   [](M m, auto to) { to.word(m.run_id ? run_id_text(*m.run_id, m.origin) : ""); }},
      RecordMember{"size_range_mm", 0, [](M m, auto to) { to.out.size_range(m); }, kLimits},
      RecordMember{"source", 2, [](M m, auto to) { to.word(word(m.source)); }},
      RecordMember{"table_revision", 13, [](M m, auto to) { to.name(m.table_revision); }},
      RecordMember{"tolerance_class", 6, [](M m, auto to) { to.name(m.class_name.value_or("")); }},
      RecordMember{"tolerance_um", 0,
                   [](M m, auto to) {
                     to.um(if_so(m.has_upper_limit() && m.has_lower_limit(),
                                 m.deviations.upper - m.deviations.lower));
                   }},
      RecordMember{"uncertainty_um", 19, [](M m, auto to) { to.um(m.standard_uncertainty); }},
      RecordMember{"upper_deviation_um", 8,
                   [](M m, auto to) { to.um(if_so(m.has_upper_limit(), m.deviations.upper)); },
                   kLimits},
      RecordMember{"upper_limit_mm", 10,
                   [](M m, auto to) { to.mm(if_so(m.has_upper_limit(), m.upper_limit())); },
                   kLimits},
      RecordMember{"verdict", 16,
                   [](M m, auto to) { to.word(m.is_judged() ? word(m.result.verdict) : ""); }},
      plain_member<I>()...);
}
(std::make_index_sequence<std::size(kMeasurementFields)>());

constexpr auto of_each(auto read) {
  return [&]<std::size_t... I>(std::index_sequence<I...>) {
    return std::array{read(at<I>(kAll))...};
  }
  (std::make_index_sequence<kAll.kCount>());
}
inline constexpr auto kNames = of_each([](const auto& member) { return member.name; });
inline constexpr auto kPlaces = of_each([](const auto& member) { return member.place; });

inline constexpr auto kByName = [] {
  std::array<std::size_t, kNames.size()> order{};
  for (std::size_t i = 0; i < order.size(); ++i) order.at(i) = i;
  std::ranges::sort(order, {}, [](std::size_t i) { return kNames.at(i); });
  return order;
}();
/// Does not compile unless each place from 1 on has one member.
inline constexpr auto kByPlace = [] {
  std::array<std::size_t, kPlaces.size() - std::ranges::count(kPlaces, 0)> order{};
  order.fill(kPlaces.size());
  for (std::size_t i = 0; i < kPlaces.size(); ++i) {
    if (kPlaces.at(i) != 0) order.at(static_cast<std::size_t>(kPlaces.at(i)) - 1) = i;
  }
  return order;
}();

template <const auto& kOrder, class Each>
void for_each(Each&& each) {
  [&]<std::size_t... K>(std::index_sequence<K...>) { (each(at<kOrder[K]>(kAll), kOrder[K]), ...); }
  (std::make_index_sequence<std::size(kOrder)>());
}

}  // namespace members

/// Calls `each(member, index)` for the members of a record as RFC 8785 sorts them.
template <class Each>
void for_each_member(Each&& each) {
  members::for_each<members::kByName>(each);
}

/// Calls `each(member, index)` for the columns of a table in their places.
template <class Each>
void for_each_column(Each&& each) {
  members::for_each<members::kByPlace>(each);
}

}  // namespace fitgauge::app
