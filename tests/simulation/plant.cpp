#include "plant.hpp"

#include "base/json/json_value.hpp"

namespace fitgauge::simulation {
namespace {

namespace fs = std::filesystem;

constexpr int kStations = 2;
constexpr int kActs = 9;
constexpr std::int64_t kLongestRest = 600 * kSecond;
constexpr std::int64_t kMaintenance = 180 * kSecond;
/// What a station sends goes by the last answer of its centre, which it asks every five seconds.
/// The first one may be of before.
constexpr std::uint64_t kQuietAnswers = 3;
constexpr std::int64_t kBetweenLooks = 2 * kSecond;
constexpr std::int64_t kHour = 3600 * kSecond;

}  // namespace

Plant::Plant(const fs::path& folder, std::uint64_t seed, Counts& counts)
    : folder_(folder), random_{seed}, counts_(counts) {
  fs::remove_all(folder_);
  network() = {};
  for (int i = 0; i <= kStations; ++i) {
    const std::string name = i == 0 ? "centre" : fmt::format("station{}", i);
    Site& site = *sites_.emplace_back(std::make_unique<Site>());
    site.is_station = i != 0;
    const std::string receiver = name + "-mes";
    site.node = std::make_unique<Node>(name, folder_ / name, i == 0 ? "" : "centre", receiver);
    network().hosts[receiver] = [this, &site](const Exchange& exchange) {
      return receive(site, exchange);
    };
    network().brokers[name + "-broker"] = [this, &site](const Published& message) {
      subscribe(site, message);
    };
    if (i == 0) {
      network().hosts["centre"] = [&site](const Exchange& exchange) {
        return site.node->answer(exchange);
      };
    }
    site.node->start();
  }
}

Plant::~Plant() {
  network().hosts.clear();
  network().brokers.clear();
  for (auto site = sites_.rbegin(); site != sites_.rend(); ++site) (*site)->node->end();
  fs::remove_all(folder_);
}

void Plant::broken(const Site& site, const std::string& what) const {
  throw Broken(fmt::format("{}: {}", site.node->machine.name, what));
}

std::string Plant::story() const {
  std::string story;
  for (const auto& site : sites_) {
    const auto& told = site->node->told;
    story += fmt::format("  {}: {}\n", site->node->machine.name, site->node->state());
    const std::size_t first = told.size() > 25 ? told.size() - 25 : 0;
    for (std::size_t i = first; i < told.size(); ++i) story += fmt::format("    {}\n", told[i]);
  }
  return story;
}

void Plant::sees(const Site& site, const std::string& who, const std::string& id,
                 const std::string& part) {
  const auto [known, is_new] = parts_.emplace(id, part);
  if (!is_new && known->second != part) {
    broken(site, fmt::format("{} has {} of {}, which was given to {} before", who, id, part,
                             known->second));
  }
}

/// As the guide to webhooks says: what has an id that was taken is a repeat.
std::optional<Reply> Plant::receive(Site& site, const Exchange& exchange) {
  if (network().weather.refused > 0 && simulation::draw(world_random(), 20) == 0)
    return Reply{.status = 503};
  const std::string id = exchange.header("webhook-id");
  const auto event = parse_json(exchange.body);
  if (!event) broken(site, "a webhook has no JSON");
  const JsonValue* const part = event->member("data").find("part_id");
  if (!site.received.emplace(id, part == nullptr ? "" : part->text).second) ++site.repeats;
  return Reply{};
}

/// As the guide to MQTT says: what has an id that was taken is a repeat.
void Plant::subscribe(Site& site, const Published& message) {
  if (message.topic.ends_with("/status")) return;
  const auto record = parse_json(message.payload);
  if (!record) broken(site, "a message has no JSON");
  const JsonValue* const part = record->find("part_id");
  site.published.emplace(record->member("id").text, part == nullptr ? "" : part->text);
}

void Plant::day() {
  static constexpr Weather kFair{};
  const auto share = [this] { return draw(2) == 0 ? 0 : draw(150); };
  network().weather = draw(3) == 0 ? kFair : Weather{share(), share(), share(), share()};
  for (int i = 0; i < kActs; ++i) act();
  network().weather = kFair;
  settle();
  check();
  sleep_till_morning();
  ++counts_.days;
}

void Plant::act() {
  Site& site = any();
  Node& node = *site.node;
  const std::uint64_t what = draw(100);
  if (what < 55) {
    post(site);
  } else if (what < 65) {
    sleep_for(static_cast<std::int64_t>(draw(3000)) * kMillisecond);
  } else if (what < 70) {
    node.machine.writes_to_live = static_cast<std::int64_t>(1 + draw(60));
  } else if (what < 74) {
    kill(site);
  } else if (what < 77) {
    node.end();
  } else if (what < 80) {
    if (!std::exchange(node.machine.is_full, draw(2) == 0) && node.machine.is_full)
      ++counts_.full_disks;
  } else if (what < 84) {
    harm_clock(site);
  } else if (what < 88) {
    copy(site);
  } else if (what < 91) {
    restore(site);
  } else if (what < 95) {
    read(site);
  } else if (!node.is_up()) {
    node.start();
  }
  for (const auto& each : sites_) bury(*each);
}

/// A client's post of a new part, or about one, and all that were not answered, again.
void Plant::post(Site& site) {
  Post post{.part = fmt::format("part-{}", ++part_)};
  if (!site.posts.empty() && draw(4) == 0) {
    Post& before = site.posts[draw(site.posts.size())];
    if (!before.id.empty() && !before.is_taken_back && !before.is_note) {
      post.is_note = draw(2) == 0;
      if (post.is_note || !std::exchange(before.is_corrected, true)) post.of = before.id;
    }
  }
  site.posts.push_back(std::move(post));
  ask_again(site);
}

void Plant::ask_again(Site& site) {
  for (Post& post : site.posts) {
    if (!post.id.empty()) continue;
    site.has_noted = site.has_noted || post.is_note;
    const auto id = post.is_note ? site.node->add_note(post.part, post.of)
                                 : site.node->post(post.part, post.of);
    const bool is_lost = draw(4) == 0;  // the answer, that is
    if (!id || is_lost) {
      ++counts_.repeated;
      return;
    }
    post.id = *id;
    sees(site, "the answer", post.id, post.part);
    ++counts_.acknowledged;
    note(std::hash<std::string>()(post.part));
  }
}

void Plant::bury(Site& site) {
  Machine& machine = site.node->machine;
  if (!machine.is_dead) return;
  site.node->end();
  machine.is_dead = false;
  machine.writes_to_live = 0;
  ++counts_.kills;
}

void Plant::kill(Site& site) {
  site.node->machine.is_dead = true;
  bury(site);
}

void Plant::harm_clock(Site& site) {
  static constexpr std::int64_t kJumps[] = {1, 5, 3600, 30 * 3600, 40 * 86'400, 400 * 86'400};
  const std::int64_t jump = kJumps[draw(std::size(kJumps))] * kSecond;
  if (site.node->is_up() && draw(2) == 0) post(site);  // it may wait for its answer meanwhile
  site.node->machine.wall_ns += draw(3) == 0 ? -jump : jump;
  ++counts_.jumps;
  // Sometimes long enough for what is done while nobody writes, such as to delete what has expired.
  sleep_for(draw(2) == 0 ? kMaintenance : static_cast<std::int64_t>(draw(2000)) * kMillisecond);
  if (site.node->is_up()) post(site);
  if (draw(2) == 0) site.node->machine.wall_ns = 0;
}

/// By `backup`, or of the folder of a station at rest that its centre has all of.
void Plant::copy(Site& site) {
  Node& node = *site.node;
  Copy copy{.path = folder_ / fmt::format("{}.{}", node.machine.name, ++site.copied)};
  copy.is_folder = site.is_station && node.is_up() && node.is_quiet() && draw(2) == 0;
  if (copy.is_folder) {
    node.end();
    if (node.machine.is_dead) return;
    fs::copy(node.folder, copy.path, fs::copy_options::recursive);
  } else if (!node.backup(copy.path)) {
    return;
  }
  for (const Post& post : site.posts) {
    if (!post.id.empty() && !post.is_taken_back) copy.ids.insert(post.id);
  }
  if (site.copies.size() == 3) {
    fs::remove_all(site.copies.front().path);
    site.copies.erase(site.copies.begin());
  }
  site.copies.push_back(std::move(copy));
}

/// Puts a copy back: a backup in the place of the database, with the files beside it or without
/// them, or a folder in the place of the folder.
void Plant::restore(Site& site) {
  Node& node = *site.node;
  if (site.copies.empty()) return;
  const Copy& copy = site.copies[draw(site.copies.size())];
  const bool is_at_centre = node.is_up() && node.is_quiet() && !site.has_noted;
  if (copy.is_folder && !is_at_centre) return;
  node.end();
  bury(site);
  node.machine.writes_to_live = 0;
  if (copy.is_folder) {
    // All but the keys: the guide to backups keeps the newest.
    const fs::path keys = folder_ / "keys";
    fs::rename(node.folder / "fitgauge.log.key", keys);
    fs::remove_all(node.folder);
    fs::copy(copy.path, node.folder, fs::copy_options::recursive);
    fs::rename(keys, node.folder / "fitgauge.log.key");
  } else {
    for (const char* suffix : {"", "-wal", "-shm"})
      fs::remove(node.folder / fmt::format("fitgauge.db{}", suffix));
    fs::copy_file(copy.path, node.folder / "fitgauge.db");
    if (draw(3) == 0) fs::remove(node.folder / "fitgauge.checkpoint");
  }
  for (Post& post : site.posts) {
    if (post.id.empty() || post.is_taken_back || copy.ids.contains(post.id)) continue;
    post.is_taken_back = true;
    ++counts_.taken_back;
  }
  // What is said of a record that is gone is refused.
  std::erase_if(site.posts, [&copy](const Post& post) {
    return post.id.empty() && !post.of.empty() && !copy.ids.contains(post.of);
  });
  site.notes.clear();
  // Records that stations send again may come in another order, which their ids do not say: the
  // guide to backups has readers of a centre begin anew.
  if (!site.is_station) site.cursor.clear();
  // An older copy of a folder is not recognised when the centre lacks what was stored after it: see
  // the explanation of proofs.
  if (!is_at_centre) std::erase_if(site.copies, [](const Copy& each) { return each.is_folder; });
  ++counts_.restores;
}

/// A reader that comes back with the last id it has; one that is not known begins anew.
void Plant::read(Site& site) {
  if (!site.node->is_up()) return;
  auto found = site.node->list(site.cursor);
  if (!found && !std::exchange(site.cursor, "").empty()) found = site.node->list();
  if (!found || found->empty()) return;
  for (const Listed& listed : *found) site.read.emplace(listed.id, listed.part);
  site.cursor = found->back().id;
}

/// All is mended: soon everything is where it should be.
void Plant::settle() {
  for (const auto& site : sites_) {
    site->node->machine.is_full = false;
    site->node->machine.writes_to_live = 0;
    site->node->machine.wall_ns = 0;
  }
  const std::int64_t until = world_now() + kLongestRest;
  std::vector<std::uint64_t> enough(sites_.size());
  for (bool was_quiet = false;;) {
    bool is_quiet = true;
    for (const auto& site : sites_) {
      bury(*site);
      if (!site->node->is_up()) site->node->start();
      if (!site->node->is_up()) is_quiet = false;
      if (!site->node->is_up()) continue;
      ask_again(*site);
      const bool is_asked = std::none_of(site->posts.begin(), site->posts.end(),
                                         [](const Post& post) { return post.id.empty(); });
      is_quiet = is_quiet && is_asked && site->node->is_quiet() && site->node->is_ready();
    }
    bool is_settled = is_quiet && was_quiet;
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      const Site& site = *sites_[i];
      const std::uint64_t asked = site.node->machine.asked;
      if (!was_quiet) enough[i] = asked + (site.is_station ? kQuietAnswers : 0);
      is_settled = is_settled && asked >= enough[i];
    }
    was_quiet = is_quiet;
    if (is_settled) break;
    if (world_now() > until) tell_what_is_not_settled();
    sleep_for(kBetweenLooks);
  }
  for (const auto& site : sites_) site->has_noted = false;
}

void Plant::tell_what_is_not_settled() const {
  for (const auto& site : sites_) {
    if (!site->node->is_up()) broken(*site, "does not start");
    if (!site->node->is_ready()) broken(*site, "is not ready");
    if (!site->node->is_quiet()) broken(*site, "has something that does not go out");
  }
  broken(*sites_.front(), "a post is not answered, or a station asks nothing of its centre");
}

void Plant::check() {
  std::vector<std::vector<Listed>> lists;
  for (const auto& site : sites_) {
    read(*site);
    auto listed = site->node->list();
    if (!listed) broken(*site, "cannot be listed");
    check_site(*site, lists.emplace_back(*std::move(listed)));
  }
  std::map<std::string, Listed> centre;
  for (const Listed& listed : lists.front()) centre.emplace(listed.id, listed);
  for (std::size_t i = 1; i < sites_.size(); ++i) check_centre(*sites_[i], lists[i], centre);
  verify(*sites_[counts_.days % sites_.size()]);
}

void Plant::verify() {
  for (const auto& site : sites_) verify(*site);
}

void Plant::verify(Site& site) {
  for (const std::string& finding : site.node->verify(site.notes))
    broken(site, "verify: " + finding);
  // A note that is there proves the ones before it: only the newest is asked for again.
  if (!site.notes.empty()) site.notes.erase(site.notes.begin(), std::prev(site.notes.end()));
}

/// Of the newest record and of any: the rest is left to verify.
void Plant::check_proofs(Site& site, const std::vector<Listed>& listed) {
  if (listed.empty()) return;
  for (const Listed& each : {listed.back(), listed[draw(listed.size())]}) {
    const std::string finding = site.node->prove(each.id);
    if (!finding.empty()) broken(site, fmt::format("proves not {}: {}", each.id, finding));
  }
}

void Plant::check_notes(const Site& site, Node& at) {
  for (const Post& post : site.posts) {
    if (!post.is_note || post.is_taken_back) continue;
    const auto notes = at.notes(post.of);
    const auto found = notes.find(post.id);
    if (found == notes.end() || found->second != post.part)
      broken(site, fmt::format("{} has not got the note {}", at.machine.name, post.id));
  }
}

void Plant::check_site(Site& site, const std::vector<Listed>& listed) {
  std::map<std::string, std::string> here;
  std::map<std::string, std::string> corrects;
  std::set<std::string> parts;
  for (const Listed& each : listed) {
    sees(site, "the list", each.id, each.part);
    if (!here.emplace(each.id, each.part).second) broken(site, "lists twice " + each.id);
    corrects[each.id] = each.corrects;
    if (site.is_station && !parts.insert(each.part).second) broken(site, "has twice " + each.part);
  }
  for (const Post& post : site.posts) {
    if (post.is_taken_back || post.is_note) continue;
    if (!here.contains(post.id)) broken(site, fmt::format("has lost {}, {}", post.id, post.part));
    if (corrects[post.id] != post.of)
      broken(site, fmt::format("has {} as a correction of '{}'", post.id, corrects[post.id]));
  }
  check_notes(site, *site.node);
  for (const auto& [id, part] : here) {
    if (!site.received.contains(id))
      broken(site, fmt::format("its receiver has not got {}, {}", id, part));
    if (!site.published.contains(id))
      broken(site, fmt::format("its broker has not got {}, {}", id, part));
    if (!site.read.contains(id))
      broken(site, fmt::format("its reader has not got {}, {}", id, part));
  }
  for (const auto& [id, part] : site.received) sees(site, "the receiver", id, part);
  for (const auto& [id, part] : site.published) sees(site, "the broker", id, part);
  for (const auto& [id, part] : site.read) sees(site, "the reader", id, part);
  site.notes.emplace(fmt::format("day {:03}", counts_.days), site.node->head());
  check_proofs(site, listed);
  note(here.size());
}

void Plant::check_centre(const Site& station, const std::vector<Listed>& here,
                         const std::map<std::string, Listed>& centre) {
  for (const Listed& listed : here) {
    const auto found = centre.find(listed.id);
    if (found == centre.end())
      broken(station, fmt::format("the centre has not got {}, {}", listed.id, listed.part));
    if (found->second.corrects != listed.corrects)
      broken(station, fmt::format("the centre has not got what {} corrects", listed.id));
  }
  check_notes(station, *sites_.front()->node);
}

/// The machines sleep, and their clocks go on.
void Plant::sleep_till_morning() {
  const std::int64_t night = 16 * kHour;
  for (const auto& site : sites_) site->node->machine.slept_ns += night;
}

}  // namespace fitgauge::simulation
