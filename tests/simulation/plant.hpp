#pragma once

#include <filesystem>

#include "node.hpp"

namespace fitgauge::simulation {

/// The run has found a defect.
class Broken : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The events of all runs.
struct Counts {
  std::uint64_t days = 0;
  std::uint64_t acknowledged = 0;
  std::uint64_t repeated = 0;  ///< posts whose answer was not seen
  std::uint64_t kills = 0;
  std::uint64_t restores = 0;
  std::uint64_t taken_back = 0;
  std::uint64_t jumps = 0;
  std::uint64_t full_disks = 0;

  void add(const Counts& more) {
    days += more.days;
    acknowledged += more.acknowledged;
    repeated += more.repeated;
    kills += more.kills;
    restores += more.restores;
    taken_back += more.taken_back;
    jumps += more.jumps;
    full_disks += more.full_disks;
  }
};

/// Stations, their centre and the receivers of all, and one who knows what was promised.
class Plant {
 public:
  Plant(const std::filesystem::path& folder, std::uint64_t seed, Counts& counts);
  ~Plant();

  /// A day of work and harm, and then of rest in which all has to come right.
  /// @throws Broken
  void day();
  /// The proofs of all, from the first record on. @throws Broken
  void verify();
  /// The logs of the machines, for a run that is broken.
  std::string story() const;

 private:
  /// A post of a client, which repeats it with its key until it is answered: a part, the correction
  /// of one, or a note beside it.
  struct Post {
    std::string part{};  ///< or the text of the note
    std::string of{};    ///< the id of the record that it corrects or says something of
    bool is_note = false;
    bool is_corrected = false;
    std::string id{};  ///< empty: not answered
    bool is_taken_back = false;
  };
  /// A copy of a folder's database, or of all of it.
  struct Copy {
    std::filesystem::path path{};
    bool is_folder = false;
    std::set<std::string> ids{};  ///< of what was promised when it was made
  };
  /// A node with those who use it.
  struct Site {
    std::unique_ptr<Node> node{};
    bool is_station = true;
    std::vector<Post> posts{};
    std::vector<Copy> copies{};
    std::map<std::string, std::string> notes{};      ///< signed heads that verify has not seen
    std::map<std::string, std::string> received{};   ///< of its webhook: part by id
    std::map<std::string, std::string> published{};  ///< by its broker: part by id
    std::uint64_t repeats = 0;
    std::string cursor{};  ///< of a reader that lists what is new
    std::map<std::string, std::string> read{};
    int copied = 0;
    bool has_noted = false;  ///< since the last rest: its centre may not have the note
  };

  std::uint64_t draw(std::uint64_t below) { return simulation::draw(random_, below); }
  Site& any() { return *sites_[draw(sites_.size())]; }
  void act();
  void post(Site& site);
  void ask_again(Site& site);
  void bury(Site& site);
  void kill(Site& site);
  void harm_clock(Site& site);
  void copy(Site& site);
  void restore(Site& site);
  void read(Site& site);
  void settle();
  [[noreturn]] void tell_what_is_not_settled() const;
  void check();
  void check_site(Site& site, const std::vector<Listed>& listed);
  void check_proofs(Site& site, const std::vector<Listed>& listed);
  void verify(Site& site);
  void check_notes(const Site& site, Node& at);
  void check_centre(const Site& station, const std::vector<Listed>& here,
                    const std::map<std::string, Listed>& centre);
  void sleep_till_morning();
  /// A record was seen: its id is of this part, for ever.
  void sees(const Site& site, const std::string& who, const std::string& id,
            const std::string& part);
  std::optional<Reply> receive(Site& site, const Exchange& exchange);
  void subscribe(Site& site, const Published& message);
  [[noreturn]] void broken(const Site& site, const std::string& what) const;

  const std::filesystem::path folder_;
  Random random_;
  Counts& counts_;
  std::vector<std::unique_ptr<Site>> sites_{};  ///< the centre first
  std::map<std::string, std::string> parts_{};  ///< by id, of all that was ever seen
  int part_ = 0;
};

}  // namespace fitgauge::simulation
