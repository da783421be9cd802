#include <fmt/ranges.h>

#include "support/deep.hpp"
#include "support/files.hpp"
#include "trial.hpp"

/// Draws mutants of the right programs of the tree, checks each and runs it on the part that its
/// original is right for. A mutant is found by a warning or error of the check, or by a run that
/// ends otherwise, judges otherwise, gives another result, or records other limits. It is
/// equivalent, and counted apart, if check, messages, verdicts, screen, files, records, presets,
/// tool data and every Q parameter but the changed one are the same to 1 nm, nothing collides, the
/// same faces of the part are touched as often, and the machine gets the same commands but for
/// rapid traverse and the points of these faces. Every other mutant is missed.
///
/// A mutant is found at its line when the first finding that its original lacks lies in the changed
/// block, or one of the other places that this finding names does: of a message and of a value that
/// was measured or read those that the run gives as its origins. A value or a file lies in the
/// block that has written it last; what is gone, in the block that has made it in the original. Of
/// a block that is left out, the block behind the gap counts, and of a TOOL CALL an error that says
/// that it is missing.
namespace fitgauge::mutants {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::uint64_t seed = 1;
  std::size_t count = static_cast<std::size_t>(rounds(60, 500));
  std::optional<std::size_t> mutant{};
  bool shows_missed = false;
  bool shows_elsewhere = false;  ///< found at another line
  /// Percent of the mutants that are found, and of those at their line; 60 scatter by 2, 500 by
  /// 0.5.
  double least = rounds(950, 985) / 10.0;
  double least_at_line = rounds(96, 98);
};

/// A subject with what its original does.
struct Original {
  Subject subject;
  std::string text;
  Outcome outcome;
  std::vector<Site> sites;
};

struct Seed {
  const char* name;
  const char* file;
  const char* setup;
};

constexpr Seed kSeeds[] = {
    {"8255", "8255.h", "live\nblock 0 0 -40 100 80 0\nbore 50 40 0 30 25.013\n"},
    {"8255", "82551.h", "live\nblock 0 0 -40 100 80 0\nbore 50 40 0 30 25.013\n"},
    {"8255", "82551.h",
     "live\nQS1 = \"h7\"\nblock 0 0 -40 100 80 0\nboss 50 40 20 20 24.986\nQ31 = 10\n"},
    {"8210", "8210.h",
     "surface 0 0 0 100 0 0 0 80 0 100 80 0 10 10 0.12 90 10 0.08 50 40 0.35 10 70 0.21 90 70 "
     "0.17\n"},
    {"444", "444.h", "surface 0 0 0 100 0 0.01 50 40 0.02 0 80 -0.015 100 80 0.045\n"},
};

struct Originals {
  std::vector<Original> all;
  std::size_t alarms = 0;  ///< of right programs
};

void add(Originals& originals, Subject subject) {
  Original original{std::move(subject), "", {}, {}};
  original.text = content_of(original.subject.folder / original.subject.file);
  original.outcome = outcome_of(original.subject, original.text);
  const Outcome& outcome = original.outcome;
  for (const Finding& alarm : outcome.alarms)
    fmt::print("right program {}: {}\n", original.subject.folder.filename().string(), alarm.text);
  originals.alarms += outcome.alarms.size();
  if (outcome.faces.empty() && !outcome.tests_itself) return;
  const fs::path called = original.subject.folder / "82551.h";
  original.sites = sites_of(original.text, fs::exists(called) ? content_of(called) : "");
  // A block that is not reached does nothing to the part.
  std::erase_if(original.sites, [&](const Site& site) {
    return site.kind != Kind::Unit && !outcome.lines.contains(site.first_line);
  });
  if (!original.sites.empty()) originals.all.push_back(std::move(original));
}

Originals originals() {
  Originals all;
  const fs::path& golden = interpreter::golden::kFolder;
  std::set<fs::path> folders{fs::directory_iterator(golden), fs::directory_iterator()};
  for (const fs::path& folder : folders) {
    const std::string setup =
        fs::exists(folder / "setup.txt") ? content_of(folder / "setup.txt") : "";
    if (fs::exists(folder / "main.h")) add(all, {folder, setup, "main.h", "main.h"});
    if (fs::exists(folder / "main.i")) add(all, {folder, setup, "main.i", "main.i"});
  }
  for (const Seed& seed : kSeeds) {
    const fs::path folder = golden / "../../../clients/nc" / seed.name;
    add(all, {folder, seed.setup, std::string(seed.name) + ".h", seed.file});
  }
  return all;
}

struct Mutant {
  const Original* original = nullptr;
  const Site* site = nullptr;
  std::vector<Edit> edits{};
};

/// Of any kind with the same likelihood, in any program that has such a place.
Mutant draw(const std::vector<Original>& originals, std::uint64_t seed, std::size_t number) {
  Random random(seed * 1'000'003 + number);
  const auto kind = static_cast<Kind>(random() % kKinds);
  for (;;) {
    const Original& original = originals[random() % originals.size()];
    std::vector<const Site*> sites;
    for (const Site& site : original.sites)
      if (site.kind == kind) sites.push_back(&site);
    if (sites.empty()) continue;
    const Site* site = sites[random() % sites.size()];
    return {&original, site, site->draw(random)};
  }
}

Judgement judge(const Mutant& mutant) {
  const Original& original = *mutant.original;
  const std::string text = edited(original.text, mutant.edits);
  const auto outcome = outcome_of(original.subject, text);
  Judgement judgement = compare(original.outcome, outcome, mutant.site->target);
  if (!judgement.differing.empty()) {
    Finding at = place_of_last(original.subject, text, judgement.differing);
    if (at.line == 0) at = place_of_last(original.subject, original.text, judgement.differing);
    judgement.at.line = at.line;
    judgement.at.notes = at.notes;
  }
  return judgement;
}

/// The lines that differ, `-` and `+`.
std::string difference(const Mutant& mutant) {
  const std::string& before = mutant.original->text;
  const std::string after = edited(before, mutant.edits);
  const auto lines = [](const std::string& text) {
    std::vector<std::string> all{""};
    for (const char each : text) each == '\n' ? all.push_back("") : all.back().push_back(each);
    return all;
  };
  const auto old = lines(before);
  const auto now = lines(after);
  std::string text =
      fmt::format("{}/{} line {}, {}\n", mutant.original->subject.folder.filename().string(),
                  mutant.original->subject.file, mutant.site->first_line, word(mutant.site->kind));
  const std::size_t fewer = old.size() - now.size();  // one block at most is left out
  for (std::size_t i = 0, j = 0; i < old.size(); ++i) {
    const bool is_out = fewer > 0 && i + 1 >= mutant.site->first_line && i < mutant.site->last_line;
    if (is_out || old[i] != now[j]) text += "  - " + old[i] + "\n";
    if (!is_out && old[i] != now[j]) text += "  + " + now[j] + "\n";
    if (!is_out) ++j;
  }
  return text;
}

/// How a finding names the block that is changed.
enum class Named : std::uint8_t {
  First,   ///< the finding itself lies there
  Other,   ///< one of the places that it names besides
  Missing  ///< a block is left out, and the finding says that this kind of block is missing
};
constexpr std::size_t kNamed = 3;

std::optional<Named> named(const Mutant& mutant, const Judgement& judgement) {
  const Site& site = *mutant.site;
  const auto is_there = [&](std::uint32_t line) {
    return line >= site.first_line && line <= site.last_line;
  };
  if (is_there(judgement.at.line)) return Named::First;
  if (std::ranges::any_of(judgement.at.notes, is_there)) return Named::Other;
  const bool is_left_out = mutant.edits.size() == 1 && mutant.edits[0].by.empty();
  if (is_left_out && site.kind == Kind::Tool &&
      judgement.at.text.find("Tool axis is missing") != std::string::npos)
    return Named::Missing;
  return std::nullopt;
}

int report(const Options& options) {
  const auto [all, alarms] = originals();
  for (std::size_t kind = 0; kind < kKinds; ++kind) {
    const auto has_kind = [&](const Site& site) { return site.kind == static_cast<Kind>(kind); };
    if (std::ranges::none_of(
            all, [&](const Original& each) { return std::ranges::any_of(each.sites, has_kind); }))
      throw std::runtime_error(
          fmt::format("no program has a place for {}", word(static_cast<Kind>(kind))));
  }
  if (options.mutant) {
    const Mutant mutant = draw(all, options.seed, *options.mutant);
    const Judgement judgement = judge(mutant);
    fmt::print("{}{}: line {} (also {}): {}\n", difference(mutant), word(judgement.found),
               judgement.at.line, fmt::join(judgement.at.notes, ", "), judgement.at.text);
    return 0;
  }
  std::map<Kind, std::array<std::size_t, kFound>> counts;
  std::array<std::size_t, kFound> sum{};
  std::array<std::array<std::size_t, kFound>, kNamed> at_line{};
  std::size_t places = 0;  ///< that the findings name
  std::size_t found_by_message = 0;
  std::set<std::pair<const Original*, std::string>> distinct;
  for (std::size_t i = 0; i < options.count; ++i) {
    const Mutant mutant = draw(all, options.seed, i);
    const Judgement judgement = judge(mutant);
    const auto at = static_cast<std::size_t>(judgement.found);
    ++counts[mutant.site->kind][at];
    ++sum[at];
    const auto how = named(mutant, judgement);
    if (how) ++at_line[static_cast<std::size_t>(*how)][at];
    if (judgement.found <= Found::Run) {
      places += 1 + judgement.at.notes.size();
      ++found_by_message;
    }
    distinct.emplace(mutant.original, edited(mutant.original->text, mutant.edits));
    const bool is_missed = judgement.found > Found::Record && judgement.found < Found::Equivalent;
    const bool is_elsewhere = judgement.found <= Found::Record && !how;
    if ((is_missed && options.shows_missed) || (is_elsewhere && options.shows_elsewhere))
      fmt::print("{} {}: {}  line {} ({}): {}\n", i, word(judgement.found), difference(mutant),
                 judgement.at.line, fmt::join(judgement.at.notes, " "), judgement.at.text);
  }
  const auto row = [](std::string_view name, const std::array<std::size_t, kFound>& numbers) {
    fmt::print("{:14}", name);
    for (const std::size_t number : numbers) fmt::print("{:>11}", number);
    fmt::print("\n");
  };
  fmt::print("{:14}", "");
  for (std::size_t i = 0; i < kFound; ++i) fmt::print("{:>11}", word(static_cast<Found>(i)));
  fmt::print("\n");
  for (const auto& [kind, numbers] : counts) row(word(kind), numbers);
  row("all", sum);
  row("at its line", at_line[static_cast<std::size_t>(Named::First)]);
  row("beside", at_line[static_cast<std::size_t>(Named::Other)]);
  row("missing", at_line[static_cast<std::size_t>(Named::Missing)]);
  fmt::print("a finding of check or run names {:.2f} places\n",
             static_cast<double>(places) /
                 static_cast<double>(std::max<std::size_t>(found_by_message, 1)));
  const auto of = [&](Found found) { return sum[static_cast<std::size_t>(found)]; };
  const std::size_t missed = of(Found::Faces) + of(Found::Commands);
  const std::size_t counted = options.count - of(Found::Equivalent);
  const double found =
      counted == 0 ? 100.0
                   : 100.0 * static_cast<double>(counted - missed) / static_cast<double>(counted);
  std::size_t named_at_all = 0;
  for (const auto& numbers : at_line)
    for (std::size_t i = 0; i <= static_cast<std::size_t>(Found::Record); ++i)
      named_at_all += numbers.at(i);
  const double at_its_line = 100.0 * static_cast<double>(named_at_all) /
                             static_cast<double>(std::max<std::size_t>(counted - missed, 1));
  fmt::print(
      "{} programs; {} mutants of seed {}, {} of them distinct; {} equivalent, {} missed, {:.2f} % "
      "found, {:.2f} % of those at their line\n",
      all.size(), options.count, options.seed, distinct.size(), of(Found::Equivalent), missed,
      found, at_its_line);
  return alarms == 0 && found >= options.least && at_its_line >= options.least_at_line ? 0 : 1;
}

Options read(int count, char** arguments) {
  Options options;
  for (int i = 1; i < count; ++i) {
    const std::string_view option = arguments[i];
    if (option == "--missed" || option == "--elsewhere") {
      (option == "--missed" ? options.shows_missed : options.shows_elsewhere) = true;
      continue;
    }
    if (i + 1 >= count)
      throw std::runtime_error(
          "mutants [--seed N] [--count N | --mutant K] [--least PERCENT] "
          "[--least-at-line PERCENT] [--missed] [--elsewhere]");
    const std::string value = arguments[++i];
    if (option == "--seed") options.seed = std::stoull(value);
    if (option == "--count") options.count = std::stoull(value);
    if (option == "--mutant") options.mutant = std::stoull(value);
    if (option == "--least") options.least = std::stod(value);
    if (option == "--least-at-line") options.least_at_line = std::stod(value);
  }
  return options;
}

}  // namespace
}  // namespace fitgauge::mutants

int main(int count, char** arguments) try {
  return fitgauge::mutants::report(fitgauge::mutants::read(count, arguments));
} catch (const std::exception& error) {
  fmt::print(stderr, "{}\n", error.what());
  return 2;
}
