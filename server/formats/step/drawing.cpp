#include "formats/step/drawing.hpp"

#include "base/digest.hpp"
#include "formats/step/values.hpp"

namespace fitgauge::step {
namespace {

using gauging::Quantity;
using iso286::Feature;

enum class Group : std::uint8_t {
  NotGauged,
  Size,
  Location,
  Angle,
  Value,
  Tolerance,
  Face,
  Surface,
  Part,
  Callout,
  Product,
  Note
};

struct Entity {
  std::string_view name;
  Group group = Group::NotGauged;
};

/// The entities to search; all others are followed from them.
constexpr Entity kEntities[] = {
    {"DIMENSIONAL_SIZE", Group::Size},
    {"DIMENSIONAL_SIZE_WITH_DATUM_FEATURE", Group::Size},
    {"DIMENSIONAL_SIZE_WITH_PATH", Group::Size},
    {"DIMENSIONAL_LOCATION", Group::Location},
    {"DIRECTED_DIMENSIONAL_LOCATION", Group::Location},
    {"DIMENSIONAL_LOCATION_WITH_PATH", Group::Location},
    {"ANGULAR_SIZE", Group::Angle},
    {"ANGULAR_LOCATION", Group::Angle},
    {"DIMENSIONAL_CHARACTERISTIC_REPRESENTATION", Group::Value},
    {"PLUS_MINUS_TOLERANCE", Group::Tolerance},
    {"GEOMETRIC_ITEM_SPECIFIC_USAGE", Group::Face},
    {"ITEM_IDENTIFIED_REPRESENTATION_USAGE", Group::Face},
    {"OPEN_SHELL", Group::Surface},
    {"SHAPE_ASPECT_RELATIONSHIP", Group::Part},
    {"SHAPE_ASPECT_DERIVING_RELATIONSHIP", Group::Part},
    {"DRAUGHTING_MODEL_ITEM_ASSOCIATION", Group::Callout},
    {"DRAUGHTING_MODEL_ITEM_ASSOCIATION_WITH_PLACEHOLDER", Group::Callout},
    {"PRODUCT", Group::Product},
    {"DRAUGHTING_CALLOUT", Group::Note},
    {"ANGULARITY_TOLERANCE"},
    {"CIRCULAR_RUNOUT_TOLERANCE"},
    {"COAXIALITY_TOLERANCE"},
    {"CONCENTRICITY_TOLERANCE"},
    {"CYLINDRICITY_TOLERANCE"},
    {"FLATNESS_TOLERANCE"},
    {"LINE_PROFILE_TOLERANCE"},
    {"PARALLELISM_TOLERANCE"},
    {"PERPENDICULARITY_TOLERANCE"},
    {"POSITION_TOLERANCE"},
    {"ROUNDNESS_TOLERANCE"},
    {"STRAIGHTNESS_TOLERANCE"},
    {"SURFACE_PROFILE_TOLERANCE"},
    {"SYMMETRY_TOLERANCE"},
    {"TOTAL_RUNOUT_TOLERANCE"},
    {"GEOMETRIC_TOLERANCE"},
    {"SURFACE_TEXTURE_REPRESENTATION"}};

/// `flatness tolerance`: an entity in words.
std::string in_words(std::string_view entity) {
  std::string words = ascii_lower(entity);
  std::ranges::replace(words, '_', ' ');
  return words;
}

constexpr auto kNames = [] {
  std::array<std::string_view, std::size(kEntities)> names{};
  for (std::size_t i = 0; i < names.size(); ++i) names.at(i) = kEntities[i].name;
  return names;
}();

/// The two ends of a relation: the places of its parameters.
struct Relation {
  Group group;
  std::size_t from;
  std::size_t to;
};
constexpr std::array kRelations = {Relation{Group::Value, 0, 1}, Relation{Group::Tolerance, 1, 0},
                                   Relation{Group::Face, 2, 4},  Relation{Group::Surface, 1, 1},
                                   Relation{Group::Part, 2, 3},  Relation{Group::Callout, 2, 4}};

/// An instance that refers to another.
using Link = std::pair<std::uint32_t, std::uint32_t>;
bool by_first(const Link& a, const Link& b) { return a.first < b.first; }

/// The quantity of a DIMENSIONAL_SIZE, by a part of its name.
constexpr std::pair<std::string_view, Quantity> kQuantities[] = {
    {"diameter", Quantity::Diameter}, {"radius", Quantity::Radius},   {"curve", Quantity::Distance},
    {"depth", Quantity::Distance},    {"thickness", Quantity::Width}, {"width", Quantity::Width},
    {"length", Quantity::Width},      {"height", Quantity::Width},    {"size", Quantity::Width},
    {"linear", Quantity::Width}};

/// Everything in the file about one dimension.
struct Found {
  std::optional<Length> nominal{};
  std::optional<Length> upper{};  ///< deviations
  std::optional<Length> lower{};
  std::string class_name{};
  std::optional<Feature> zone{};  ///< of the class
  bool is_angle = false;
  bool is_open = false;  ///< all its faces are of open shells
};

std::string signed_um(std::optional<Length> length) {
  return !length ? "none" : (*length > Length() ? "+" : "") + format_um(*length);
}

class Walker {
 public:
  Walker(const Part21& file, const iso286::ToleranceTables& tables, Drawing& drawing)
      : file_(file), tables_(tables), to_(drawing), values_(file) {}

  void walk() {
    for (const Relation& relation : kRelations) {
      each({relation.group},
           [&](auto id, const Entity& entity) { link(id, relation, entity.name); });
    }
    for (auto& each : links_) std::ranges::stable_sort(each, by_first);
    for (const auto& [_, id] : links(Group::Face)) {
      if (links(Group::Surface).empty() || links(Group::Face).size() > kMostLooked) break;
      const auto face = is_open(id) ? std::nullopt : read_face(file_, id);
      if (face && face->radius > 0) solids_.push_back(*face);
    }
    each({Group::Product}, [&](auto id, const Entity& entity) {
      to_.part = seen_.empty() ? text_in(file_, id, entity.name, 0) : std::string();
      to_.part.resize(first_characters(to_.part, kLongestName).size());
      seen_.insert(id);
    });
    each({Group::Size, Group::Location, Group::Angle}, [&](auto id, const Entity& entity) {
      if (seen_.insert(id).second) dimension(id, entity);
    });
    each({Group::NotGauged}, [&](auto id, const Entity& entity) {
      if (seen_.insert(id).second)
        refuse(id, name_of(id, entity.name), in_words(entity.name) + " is not gauged here");
    });
    std::set<std::uint32_t> used;
    for (const auto& [definition, callout] : links(Group::Callout)) {
      if (seen_.contains(definition)) used.insert(callout);
    }
    each({Group::Note}, [&](auto id, const Entity& entity) {
      if (!used.contains(id))
        refuse(id, text_in(file_, id, entity.name, 0),
               "a note, a datum or another text is not gauged here");
    });
  }

 private:
  template <class Each>
  void each(std::initializer_list<Group> groups, const Each& what) {
    for (std::size_t i = 0; i < std::size(kEntities); ++i) {
      if (std::ranges::find(groups, kEntities[i].group) == groups.end()) continue;
      for (const std::uint32_t id : file_.of_name(i)) what(id, kEntities[i]);
    }
  }
  std::vector<Link>& links(Group group) { return links_[static_cast<std::size_t>(group)]; }
  std::span<const Link> linked(Group group, std::uint32_t from) {
    const auto [first, last] =
        std::equal_range(links(group).begin(), links(group).end(), Link(from, 0), by_first);
    return {first, last};
  }

  void link(std::uint32_t id, const Relation& relation, std::string_view name) {
    const auto all = record_of(file_, id, name);
    const bool is_shell = relation.group == Group::Surface;  // links each face to itself
    if (all.size() <= std::max(relation.from, relation.to) ||
        (!is_shell && !all[relation.from].is(Kind::Reference)))
      return;
    for (const std::uint32_t to : references_in(file_, all[relation.to])) {
      links(relation.group).emplace_back(is_shell ? to : all[relation.from].id, to);
      if (++link_count_ > kMostLinks)
        return file_.fail(id, "too many relations: export fewer parts");
    }
  }

  void refuse(std::uint32_t id, std::string name, std::string why) {
    if (to_.not_read.size() == kMostListed)
      file_.fail(id, "more than 20000 tolerances and notes: export fewer parts");
    if (file_.error()) return;
    to_.not_read.push_back({fmt::format("#{}", id), std::move(name), std::move(why)});
  }

  std::string callout_of(std::uint32_t id) {
    std::string name;
    for (const auto& [_, callout] : linked(Group::Callout, id)) {
      if (name.empty()) name = text_in(file_, callout, "DRAUGHTING_CALLOUT", 0, id);
    }
    return name;
  }
  /// Returns the name of its callout, else of the dimension, else its entity in words.
  std::string name_of(std::uint32_t id, std::string_view entity) {
    std::string name = callout_of(id);
    if (name.empty()) name = text_in(file_, id, entity, 0);
    if (name.empty()) name = text_in(file_, id, "GEOMETRIC_TOLERANCE", 0);
    return name.empty() ? in_words(entity) : name;
  }
  std::string unique(std::string name) {
    name.resize(first_characters(name, kLongestName).size());
    std::string free = name;
    for (int& count = names_[name]; ++count > 1;) {
      free = fmt::format("{} ({})", name, count);
      if (names_.try_emplace(free, 1).second) break;
    }
    return free;
  }

  bool is_open(std::uint32_t face) { return !linked(Group::Surface, face).empty(); }

  std::vector<Face> faces_of(std::uint32_t aspect) {
    constexpr std::size_t kMostAspects = 4096;
    constexpr std::size_t kMostFaces = 256;
    std::vector<std::uint32_t> aspects{aspect};
    std::vector<Face> faces;
    std::set<std::uint32_t> known{aspect};
    for (std::size_t i = 0; i < aspects.size() && i < kMostAspects; ++i) {
      for (const auto& [_, id] : linked(Group::Face, aspects[i])) {
        if (faces.size() == kMostFaces) return faces;
        auto face = read_face(file_, id);
        if (face && is_open(id)) lay_on(*face, solids_);
        if (face) faces.push_back(*face);
      }
      for (const auto& [_, part] : linked(Group::Part, aspects[i])) {
        if (known.insert(part).second) aspects.push_back(part);
      }
    }
    return faces;
  }

  /// Nominal value, limits and words of the representation. @returns why it cannot be used
  std::string take_values(std::uint32_t id, Found& found, DrawnSize& size) {
    std::optional<Length> upper;
    std::optional<Length> lower;
    for (const auto& [_, each] : linked(Group::Value, id)) {
      for (const Record& representation : file_.records(each, id)) {
        const auto all = file_.parameters(representation.list);
        const auto items =
            std::ranges::find_if(all, [](const Parameter& p) { return p.is(Kind::List); });
        if (items == all.end()) continue;
        for (const std::uint32_t item : references_in(file_, *items))
          take_value(item, each, found, upper, lower, size);
      }
    }
    if (!found.nominal && lower) {
      found.nominal = lower;
      size.remarks.emplace_back("the file has limits but no nominal size: the lower limit is used");
    }
    if (!found.nominal)
      return found.is_angle ? "an angle is not gauged here"
                            : "the file has no value: read it from the drawing";
    if (upper && lower && *upper < *lower) {
      size.remarks.push_back(
          fmt::format("upper limit {} mm, lower limit {} mm in the file: the order is wrong there",
                      format_mm(*upper), format_mm(*lower)));
      std::swap(upper, lower);
    }
    if (upper && upper == lower)
      return fmt::format("both limits are {} mm: the file lacks a tolerance", format_mm(*upper));
    if (upper) found.upper = *upper - *found.nominal;
    if (lower) found.lower = *lower - *found.nominal;
    return {};
  }

  void take_value(std::uint32_t id, std::uint32_t from, Found& found, std::optional<Length>& upper,
                  std::optional<Length>& lower, DrawnSize& size) {
    if (std::string words = text_in(file_, id, "DESCRIPTIVE_REPRESENTATION_ITEM", 1, from);
        !words.empty()) {
      size.modifiers.push_back(std::move(words));
      return;
    }
    const Value read = values_.read(id, from);
    if (!read.length) {
      found.is_angle = true;
      return;
    }
    const bool is_limit = read.name == "upper limit" || read.name == "lower limit";
    if (read.name == "upper limit" || read.qualifier == "maximum") upper = read.length;
    if (read.name == "lower limit" || read.qualifier == "minimum") lower = read.length;
    if (!is_limit) found.nominal = read.length;
    if (read.length != read.exact)
      size.remarks.push_back(fmt::format("the model has {} mm, its callout shows {} mm",
                                         format_mm(*read.exact), format_mm(*read.length)));
  }

  /// Class or deviations of the tolerances. @returns why they cannot be used
  std::string take_tolerances(std::uint32_t id, Found& found, DrawnSize& size) {
    for (const auto& [_, each] : linked(Group::Tolerance, id)) {
      const auto fit = record_of(file_, each, "LIMITS_AND_FITS", id);
      if (fit.size() >= 3) {
        std::string grade = text_of(fit[2]);
        if (ascii_upper(grade).starts_with("IT")) grade.erase(0, 2);
        found.class_name = std::string(trim(text_of(fit[0]))) + std::string(trim(grade));
        found.class_name.resize(first_characters(found.class_name, kLongestClass).size());
        found.zone = iso286::feature_from_word(ascii_lower(trim(text_of(fit[1]))));
      }
      const auto range = record_of(file_, each, "TOLERANCE_VALUE", id);
      if (range.size() != 2 || !range[0].is(Kind::Reference) || !range[1].is(Kind::Reference))
        continue;
      const auto low = values_.read(range[0].id, each).length;
      const auto high = values_.read(range[1].id, each).length;
      if (!low || !high) return "an angle is not gauged here";
      const std::string both = fmt::format("lower deviation {} µm, upper deviation {} µm",
                                           signed_um(*low), signed_um(*high));
      if (*low == *high) return both + ": the file lacks a sign or a tolerance";
      if (*low > *high && *high > Length())
        return both + ": the sign or the order is wrong in the file";
      if (*low > *high) size.remarks.push_back(both + " in the file: the order is wrong there");
      const Length upper = std::max(*low, *high);
      const Length lower = std::min(*low, *high);
      const bool contradicts =
          (found.upper && *found.upper != upper) || (found.lower && *found.lower != lower);
      if (contradicts) return both + ": its limits differ";
      found.upper = upper;
      found.lower = lower;
    }
    return {};
  }

  /// @returns why the class cannot be used
  std::string take_class(const Found& found, DrawnSize& size) {
    const auto nominal = iso286::NominalSize::make(size.nominal);
    if (!nominal) return nominal.error().message;
    const auto limits = tables_.limits_of_size(*nominal, found.class_name);
    if (!limits) return limits.error().message;
    const auto contradiction = [&](std::string_view other) {
      return fmt::format("{} {} is {} {} µm of a {}, and {}: choose one from the drawing",
                         format_mm(size.nominal), found.class_name,
                         signed_um(limits->deviations.upper), signed_um(limits->deviations.lower),
                         word(limits->feature), other);
    };
    const bool agrees =
        found.upper.value_or(limits->deviations.upper) == limits->deviations.upper &&
        found.lower.value_or(limits->deviations.lower) == limits->deviations.lower;
    if (!agrees) {
      return contradiction(fmt::format("the limits of the file are {} {} µm",
                                       signed_um(found.upper), signed_um(found.lower)));
    }
    if (found.zone && *found.zone != limits->feature)
      return contradiction(fmt::format("the file calls it a {}", word(*found.zone)));
    if (size.feature && *size.feature != limits->feature)
      return contradiction(fmt::format("its faces are those of a {}", word(*size.feature)));
    size.feature = limits->feature;
    size.tolerance_class = found.class_name;
    return {};
  }

  /// The feature of a size, by its name and its faces.
  void take_aspect(std::uint32_t aspect, std::string_view name, Found& found, DrawnSize& size) {
    for (const auto& [part, quantity] : kQuantities) {
      if (name.find(part) == std::string_view::npos) continue;
      size.quantity = quantity;
      break;
    }
    const Shape shape = shape_of(faces_of(aspect));
    found.is_open = shape.is_open;
    size.count = size.quantity == Quantity::Radius && shape.faces > 0 ? shape.faces : shape.count;
    // The length of a round face is a depth.
    if (size.quantity == Quantity::Width && shape.is_round) size.quantity = Quantity::Distance;
    if (gauging::has_feature(size.quantity)) size.feature = shape.feature;
  }

  std::string take_size(std::uint32_t id, const Entity& entity, DrawnSize& size) {
    if (entity.group == Group::Angle) return "an angle is not gauged here";
    size.quantity = Quantity::Distance;
    Found found;
    if (entity.group == Group::Size) {
      auto own = record_of(file_, id, "DIMENSIONAL_SIZE");
      if (own.empty()) own = record_of(file_, id, entity.name);
      // The aspect and the name are adjacent, in a subtype not at its beginning.
      const auto aspect = std::ranges::adjacent_find(own, [](const auto& a, const auto& b) {
        return a.is(Kind::Reference) && b.is(Kind::Text);
      });
      if (aspect != own.end())
        take_aspect(aspect->id, ascii_lower(text_of(aspect[1])), found, size);
    }
    if (std::string why = take_values(id, found, size); !why.empty()) return why;
    size.nominal = *found.nominal;
    if (std::string why = take_tolerances(id, found, size); !why.empty()) return why;
    const Length least = size.nominal + std::min(Length(), found.lower.value_or(Length()));
    if (!gauging::is_signed(size.quantity) && least <= Length()) {
      return fmt::format("{} mm, {} {} µm: a {} is above 0, a sign is wrong in the file",
                         format_mm(size.nominal), signed_um(found.upper), signed_um(found.lower),
                         word(size.quantity));
    }
    for (const std::string_view word : {"theoretical", "auxiliary", "basic", "reference"}) {
      if (std::ranges::find(size.modifiers, word) != size.modifiers.end())
        return fmt::format("{} mm is {}: it has no limits", format_mm(size.nominal), word);
    }
    if (!found.upper && !found.lower && found.class_name.empty()) {
      return fmt::format(
          "{} mm has no limits in the file: add those of the drawing's general tolerances",
          format_mm(size.nominal));
    }
    if (!found.class_name.empty()) return take_class(found, size);
    size.upper = found.upper;
    size.lower = found.lower;
    // Without faces a width is a distance: outside of its limits a part is a reject.
    if (size.quantity == Quantity::Width && !size.feature) size.quantity = Quantity::Distance;
    if (gauging::has_feature(size.quantity) && !size.feature) {
      return fmt::format("{} mm, {} {} µm: its faces {}, add it with its feature",
                         format_mm(size.nominal), signed_um(size.upper), signed_um(size.lower),
                         found.is_open ? "are of an open shell, which has no side with material"
                                       : "do not show a hole or a shaft");
    }
    return {};
  }

  void dimension(std::uint32_t id, const Entity& entity) {
    DrawnSize size;
    size.entity = fmt::format("#{}", id);
    const std::string why = take_size(id, entity, size);
    if (to_.sizes.size() == kMostListed)
      file_.fail(id, "more than 20000 sizes: export fewer parts");
    if (!why.empty()) return refuse(id, name_of(id, entity.name), why);
    std::string name = callout_of(id);
    if (name.empty()) name = fmt::format("{} {}", word(size.quantity), format_mm(size.nominal));
    size.name = unique(std::move(name));
    to_.sizes.push_back(std::move(size));
  }

  static constexpr std::size_t kMostLinks = std::size_t{2} << 20;
  static constexpr std::size_t kMostLooked = 1024;  ///< faces for the side of a copy
  static constexpr std::size_t kMostListed = 20'000;
  static constexpr std::size_t kLongestName = 180;  ///< of 200, so that a number can be added
  static constexpr std::size_t kLongestClass = 64;

  const Part21& file_;
  const iso286::ToleranceTables& tables_;
  Drawing& to_;
  Values values_;
  std::size_t link_count_ = 0;
  std::array<std::vector<Link>, std::size(kEntities)> links_;
  std::map<std::string, int> names_;
  std::set<std::uint32_t> seen_;
  std::vector<Face> solids_;  ///< cylinders that sizes and tolerances hang on
};

}  // namespace

Result<Drawing> read_drawing(const FileText& text, const iso286::ToleranceTables& tables,
                             std::size_t most_instances) {
  const auto file = TRY(Part21::read(text, kNames, most_instances));
  Drawing drawing;
  Walker(file, tables, drawing).walk();
  if (file.error()) return *file.error();
  Sha256 digest;
  text.each_stretch(text.text.size(), [&](std::string_view part) { digest.update(part); });
  drawing.digest = to_hex(digest.finish());
  return drawing;
}

}  // namespace fitgauge::step
