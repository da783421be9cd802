#include "metrology/statistics/gauge_study.hpp"

#include "api/statistics/study_rows.hpp"
#include "api/wire/formulas.hpp"

namespace fitgauge::api {

/// Ratings with their labels.
struct RatingsOrder {
  StudyLabels parts{};
  StudyLabels operators{};
  StudyLabels categories{};
  std::optional<std::string> good{};
  metrology::Ratings ratings{};
  std::map<std::size_t, std::size_t> references{};
  StudyLabels trials{};
  std::vector<std::size_t> trial{};  ///< of each rating, if all have one
  std::set<std::tuple<std::size_t, std::size_t, std::string>> seen{};
};
void row_members(auto& v, RatingsOrder& study) {
  std::optional<std::string> part, by, trial, value, reference;
  v.member("part", part, StudyLabel{});
  v.member("operator", by, StudyLabel{});
  v.optional("trial", trial, StudyLabel{});
  v.member("value", value, StudyLabel{}, "Category given in this trial");
  v.optional("reference", reference, StudyLabel{}, "The right category of the part");
  v.check([&](FieldReader& row) {
    if (!part || !by || !value) return;
    metrology::Ratings& ratings = study.ratings;
    ratings.part.push_back(study.parts.number(*part));
    ratings.operators.push_back(study.operators.number(*by));
    ratings.category.push_back(study.categories.number(*value));
    if (trial) study.trial.push_back(study.trials.number(*trial));
    if (trial &&
        !study.seen.emplace(ratings.part.back(), ratings.operators.back(), *trial).second) {
      row.report(ErrorCode::FieldConflict, "trial",
                 "this trial of the part by this operator is repeated");
    }
    if (!reference) return;
    const std::size_t category = study.categories.number(*reference);
    if (study.references.try_emplace(ratings.part.back(), category).first->second != category) {
      row.report(ErrorCode::FieldConflict, "reference",
                 "another row has another reference of this part");
    }
  });
}
void members(auto& v, RatingsOrder& study) {
  std::string method;
  v.member("method", method, Word{"attribute"});
  v.optional("good", study.good, StudyLabel{},
             "The category of accepted parts, for misses and alarms");
  v.member("measurements", study, StudyRows<RatingsOrder>{},
           "Ratings, in the order of their trials if these have no name");
  v.check([&study](FieldReader& fields) {
    const std::size_t known = study.references.size();
    if (known > 0 && known < study.parts.size()) {
      fields.report(ErrorCode::FieldMissing, "measurements",
                    "give the reference of every part, or of none");
    } else if (study.good && known == 0) {
      fields.report(ErrorCode::FieldConflict, "good", "good needs parts with a reference");
    } else if (study.good && !study.categories.has(*study.good)) {
      fields.report(ErrorCode::FieldInvalid, "good",
                    "good must be a value or a reference of the measurements; got '{}'",
                    first_characters(*study.good, 40));
    }
  });
}

void members(auto& v, const metrology::AttributeShare& share) {
  v.member("count", share.count);
  v.member("of", share.of);
  v.member("percent", 100 * static_cast<double>(share.count) / static_cast<double>(share.of));
  v.member("lower_percent", 100 * share.lower, "Clopper and Pearson 1934, of 95 %");
  v.member("upper_percent", 100 * share.upper);
}

void members(auto& v, const metrology::AttributeStudy::Operator& rater) {
  v.member("operator", rater.name);
  v.member("consistent", rater.consistent, "Parts that all trials rate alike");
  v.member("kappa_within", rater.within, "Fleiss 1971, of the trials");
  v.optional("effectiveness", rater.effectiveness, "Parts that all trials rate right");
  v.member("kappa_reference", rater.reference, "Cohen 1960; null without a reference");
  v.optional("misses", rater.misses, "Ratings of bad parts that are good");
  v.optional("false_alarms", rater.false_alarms, "Ratings of good parts that are bad");
}
void members(auto& v, const metrology::AttributeStudy::Pair& pair) {
  v.member("operators", pair.names);
  v.member("kappa", pair.kappa, "Cohen 1960, trial by trial");
}
void members(auto& v, const metrology::AttributeStudy& study) {
  v.member("method", "attribute", Word{"attribute"});
  formula_members(v, "attribute");
  v.member("operators", study.operators);
  v.member("pairs", study.pairs);
  v.member("kappa_between", study.between, "Fleiss 1971, of all ratings");
  v.member("alike", study.alike, "Parts that all rate alike in all trials");
  v.optional("effectiveness", study.right, "Parts that all rate right in all trials");
}

namespace {

/// Puts ratings that name their trials into the order of the trials, which are compared.
void sort_by_trial(metrology::Ratings& ratings, const std::vector<std::size_t>& trial) {
  std::vector<std::size_t> order(ratings.part.size());
  if (trial.size() != order.size()) return;
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return trial[i]; });
  const metrology::Ratings given = ratings;
  for (std::size_t i = 0; i < order.size(); ++i) {
    ratings.part[i] = given.part[order[i]];
    ratings.operators[i] = given.operators[order[i]];
    ratings.category[i] = given.category[order[i]];
  }
}

}  // namespace

Result<std::string> attribute_study(const JsonValue& body) {
  auto order = TRY(read_whole<RatingsOrder>(body));
  metrology::Ratings& ratings = order.ratings;
  sort_by_trial(ratings, order.trial);
  for (const auto& [part, category] : order.references) ratings.reference.push_back(category);
  if (order.good) ratings.good = order.categories.number(*order.good);
  ratings.parts = order.parts.size();
  ratings.names = order.operators.names();
  ratings.categories = order.categories.size();
  const auto study = metrology::study_attributes(ratings);
  if (!study) return at_member("measurements", study.error());
  return body_json(*study);
}

void add_attribute_study_schemas(Schemas& schemas) {
  schemas.push_back(order_schema<RatingsOrder>("AttributeStudyOrder"));
  schemas.push_back(answer_schema<metrology::AttributeStudy>("AttributeStudy"));
}

}  // namespace fitgauge::api
