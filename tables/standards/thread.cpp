#include "tables/standards/standard.hpp"

namespace fitgauge::standards {
namespace {

const Standard& standard() {
  static const Standard& found = *find("iso965-1");
  return found;
}

/// `6H`: a grade and a position.
struct ThreadClass {
  char grade = '6';
  char position = 'H';

  bool is_internal() const { return position >= 'A' && position <= 'Z'; }
};

struct Thread {
  Length diameter;
  Length pitch;
  std::optional<Length> coarse;
  ThreadClass pitch_class{};
  std::string classes{};  ///< as given: `6g`, `5g6g`
};

Error not_a_thread(std::string_view text) {
  return {ErrorCode::DesignationMalformed,
          fmt::format("'{}' is not a thread such as M10-6H or M10x1.25-6g",
                      first_characters(text, 40))};
}

/// Returns whether it is a class of the crests: the minor diameter of internal threads, the major
/// diameter of external ones.
bool is_crest_class(const ThreadClass& of) {
  constexpr std::string_view kInternal = "45678";
  constexpr std::string_view kExternal = "468";
  constexpr std::string_view kPositions = "GHefgh";
  return (of.is_internal() ? kInternal : kExternal).find(of.grade) != std::string_view::npos &&
         kPositions.find(of.position) != std::string_view::npos;
}

std::optional<ThreadClass> class_of(std::string_view text) {
  if (text.size() < 2 || text[0] < '1' || text[0] > '9' || !is_ascii_letter(text[1])) {
    return std::nullopt;
  }
  return ThreadClass{.grade = text[0], .position = text[1]};
}

/// Reads the size at the front: digits with a point or a comma.
Result<Length> take_size(std::string_view& rest, std::string_view whole) {
  const auto* const stop = std::ranges::find_if(
      rest, [](char c) { return (c < '0' || c > '9') && c != '.' && c != ','; });
  const auto end = static_cast<std::size_t>(stop - rest.begin());
  const auto size = parse_length_mm(rest.substr(0, end), {.decimal_comma = true});
  rest.remove_prefix(end);
  if (size && *size > Length()) return *size;
  if (!size && size.error().code == ErrorCode::LengthTooFine) return size.error();
  return not_a_thread(whole);
}

bool take(std::string_view& rest, std::string_view what) {
  if (!rest.starts_with(what)) return false;
  rest.remove_prefix(what.size());
  return true;
}

/// The coarse pitch of a diameter of ISO 261. @errors ClassUndefinedForSize
Result<std::optional<Length>> coarse_pitch(Length diameter) {
  for (const Row& row : standard().table("diameters").rows) {
    if (row.diameter == diameter) return row.length("coarse_pitch", Member::Nominal);
  }
  return Error{ErrorCode::ClassUndefinedForSize,
               fmt::format("M{} is not a thread of ISO 261", format_mm(diameter))};
}

Result<Thread> parse(std::string_view designation) {
  std::string_view rest = designation;
  if (!take(rest, "M") && !take(rest, "m")) return not_a_thread(designation);
  const auto diameter = TRY(take_size(rest, designation));
  Thread thread{.diameter = diameter, .pitch = {}, .coarse = {}};
  const bool has_pitch = take(rest, "x") || take(rest, "X") || take(rest, "\xC3\x97");
  if (has_pitch) thread.pitch = TRY(take_size(rest, designation));
  const bool hyphen = take(rest, "-");
  const auto first = class_of(rest);
  const auto second = class_of(rest.size() > 2 ? rest.substr(2) : "");
  if (!hyphen || !first || (rest.size() != 2 && !(rest.size() == 4 && second)) ||
      (second && (second->is_internal() != first->is_internal() || !is_crest_class(*second)))) {
    return not_a_thread(designation);
  }
  thread.pitch_class = *first;
  thread.classes = rest;
  const auto coarse = TRY(coarse_pitch(diameter));
  thread.coarse = coarse;
  if (!has_pitch && !thread.coarse) {
    return Error{ErrorCode::ClassUndefinedForSize,
                 fmt::format("M{0} has no coarse pitch: name its pitch, as in M{0}x1-6H",
                             format_mm(diameter))};
  }
  if (!has_pitch) thread.pitch = *thread.coarse;
  return thread;
}

Result<Length> tolerance_of(const Thread& thread) {
  const ThreadClass& of = thread.pitch_class;
  const std::string item =
      fmt::format("{}_{}", of.is_internal() ? "internal" : "external", of.grade);
  bool has_pitch = false;
  for (const Row& row : standard().table("pitch_diameters").rows) {
    if (row.pitch != thread.pitch || !row.holds(thread.diameter)) continue;
    has_pitch = true;
    if (const auto tolerance = row.length(item, Member::Tolerance)) return *tolerance;
  }
  const std::string name =
      fmt::format("M{}x{}", format_mm(thread.diameter), format_mm(thread.pitch));
  if (!has_pitch) {
    return Error{ErrorCode::ClassUndefinedForSize,
                 fmt::format("ISO 965-1 has no tolerance of the pitch diameter of {}", name)};
  }
  return Error{ErrorCode::ClassUndefinedForSize,
               fmt::format("ISO 965-1 has no grade {} for the pitch diameter of the {} thread {}",
                           of.grade, of.is_internal() ? "internal" : "external", name)};
}

Result<Length> deviation_of(const Thread& thread) {
  const std::string_view position(&thread.pitch_class.position, 1);
  bool is_known = false;
  for (const Row& row : standard().table("positions").rows) {
    const auto deviation = row.length(position, Member::Deviation);
    is_known = is_known || deviation;
    if (deviation && row.pitch == thread.pitch) return *deviation;
  }
  if (is_known) {
    return Error{ErrorCode::ClassUndefinedForSize,
                 fmt::format("ISO 965-1 has no position {} for a pitch of {} mm", position,
                             format_mm(thread.pitch))};
  }
  if (position >= "a" && position <= "d") {
    return Error{ErrorCode::ClassUnknown,
                 fmt::format("the position {} of ISO 965-1 is not available: give its limits by "
                             "nominal_mm, feature, upper_um, lower_um",
                             position)};
  }
  return Error{
      ErrorCode::ClassUnknown,
      fmt::format(
          "unknown position {}: internal threads have G and H, external threads have e, f, g and h",
          position)};
}

/// d - 3 sqrt(3) P / 8, to the micrometre.
Length pitch_diameter_of(const Thread& thread) {
  constexpr std::int64_t kFactor = 649'519'053;  // 3 sqrt(3) / 8, in 1e-9
  constexpr std::int64_t kOne = 1'000'000'000;
  constexpr std::int64_t kMicrometre = 1'000;
  const std::int64_t off = (thread.pitch.count() * kFactor + kOne / 2) / kOne;
  const std::int64_t exact = thread.diameter.count() - off;
  return Length::nanometres((exact + kMicrometre / 2) / kMicrometre * kMicrometre);
}

/// Returns the shared spelling of a designation, which is kept for ever: the standard limits the
/// number of threads.
std::string_view kept(std::string designation) {
  static std::mutex mutex;
  static std::set<std::string, std::less<>> spellings;
  const std::lock_guard lock(mutex);
  return *spellings.insert(std::move(designation)).first;
}

}  // namespace

Result<DesignatedLimits> thread_limits(std::string_view designation) {
  const auto thread = TRY(parse(designation));
  const auto away = TRY(deviation_of(thread));
  const auto tolerance = TRY(tolerance_of(thread));
  const bool internal = thread.pitch_class.is_internal();
  const std::string pitch =
      thread.pitch == thread.coarse ? std::string() : "x" + format_mm(thread.pitch);
  return DesignatedLimits{.standard = &standard(),
                          .tolerance_class = kept(fmt::format(
                              "M{}{}-{}", format_mm(thread.diameter), pitch, thread.classes)),
                          .feature = internal ? iso286::Feature::Hole : iso286::Feature::Shaft,
                          .nominal = pitch_diameter_of(thread),
                          .deviations = internal ? iso286::LimitDeviations{away + tolerance, away}
                                                 : iso286::LimitDeviations{away, away - tolerance}};
}

}  // namespace fitgauge::standards
