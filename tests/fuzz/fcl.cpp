// SPDX-License-Identifier: MIT
// Histories of an FCL manager against brute force: which calls a query makes, in which order, with which object first;
// stopped and left by an exception at any call; with queries inside of callbacks.
//
// Input: byte 0: bit 0 double, bit 1 an executor that claims 4 threads, bit 2 updates and queries each in another
// floating-point environment, bit 3 all calls in order of registration, not those of self queries alone; byte 1: how
// many boxes there are (bytes.hpp); these; byte 2: how many more objects, drawn with the seed in byte 3. All objects
// have numbers from 0 on. Then operations: a byte for the kind (order of `Kind`; f8 to ff for the last four), a byte
// for an object, and what the kind takes.
#include <algorithm>
#include <limits>
#include <random>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "bytes.hpp"
#include "core/executors.hpp"
#include "either_scalar.hpp"
#include "fcl/model.hpp"
#include "fcl_script.hpp"
#include "finding.hpp"
#include "float_environment.hpp"

namespace boxstream::fuzz {
namespace {

using fcl_test::Calls;

constexpr int most_ops = 40;

enum class Kind {
  add,
  add_many,
  add_static,
  remove,
  remove_many,
  set_box,       // without a call to the manager
  set_box_told,  // with one
  shift_many,
  update,
  update_many,
  groups,
  make_static,
  add_to_other,
  clear,
  collide,
  collide_one,
  collide_other,
  distance,
  distance_one,
  distance_other,
  count,
  margin = count,
  source,
  move_to_new,
  exchange
};

template <class S>
class History {
 public:
  History(Bytes& in, Executor* executor, bool has_moods, bool is_ordered)
      : in_(in), has_moods_(has_moods), is_ordered_(is_ordered), manager_(executor) {
    manager_.setRegistrationOrder(is_ordered);
    other_.setRegistrationOrder(is_ordered);
    const unsigned own = in.below(64);
    for (unsigned i = 0; i < own; ++i) scene_.add(fcl_box(in.box<S>()));
    const unsigned drawn = in.below(128);
    std::minstd_rand random(1u + in.byte());
    for (unsigned i = 0; i < drawn || i == 0; ++i) scene_.add(fcl_box(drawn_box<S>(random, 12)));
  }

  void step() {
    const Kind kind = read_kind();
    fcl_test::BoxObject<S>& object = any();
    switch (kind) {
      case Kind::add:
        manager_.registerObject(&object);
        model_.put(object);
        break;
      case Kind::add_many:
        manager_.registerObjects(pointers(some()));
        for (auto* const each : picked_) model_.put(*each);
        break;
      case Kind::add_static:
        manager_.registerStaticObjects(pointers(some()));
        for (auto* const each : picked_) model_.put_static(*each);
        break;
      case Kind::remove:
        manager_.unregisterObject(&object);
        model_.erase(object);
        break;
      case Kind::remove_many:
        for (auto* const each : some()) {
          manager_.unregisterObject(each);
          model_.erase(*each);
        }
        break;
      case Kind::set_box:
        object.set(fcl_box(in_.box<S>()));
        break;
      case Kind::set_box_told:
        object.set(fcl_box(in_.box<S>()));
        in_some_mood([&] { manager_.update(&object); });
        model_.look(object);
        break;
      case Kind::shift_many:
        shift(some(), in_.number<S>());
        break;
      case Kind::update:
        in_some_mood([&] { manager_.update(); });
        model_.look();
        break;
      case Kind::update_many:
        in_some_mood([&, many = pointers(some())] { manager_.update(many); });
        for (auto* const each : picked_) model_.look(*each);
        break;
      case Kind::groups: {
        const boxstream::fcl::Groups groups{in_.byte(), in_.byte()};
        promise(manager_.setGroups(&object, groups) == model_.set_groups(object, groups), "setGroups");
        break;
      }
      case Kind::make_static: {
        const bool is_static = in_.below(2) == 1;
        promise(manager_.setStatic(&object, is_static) == model_.set_static(object, is_static), "setStatic");
        break;
      }
      case Kind::add_to_other:
        other_.registerObject(&object);
        other_model_.put(object);
        break;
      case Kind::clear:
        manager_.clear();
        model_.clear();
        break;
      case Kind::collide:
        check(model_.collide(), "collide", true, [&](auto& script) { manager_.collide(&script, script.on_pair); });
        break;
      case Kind::collide_one:
        check(by_registration(model_.collide(object), model_), "collide with one", is_ordered_,
              [&](auto& script) { manager_.collide(&object, &script, script.on_pair); });
        break;
      case Kind::collide_other:
        check(by_registration(model_.collide(other_model_), other_model_), "collide with a manager", is_ordered_,
              [&](auto& script) { manager_.collide(&other_, &script, script.on_pair); });
        break;
      case Kind::distance:
        check_distance(model_.all_pairs(), "distance",
                       [&](auto& script) { manager_.distance(&script, script.on_distance); });
        break;
      case Kind::distance_one:
        check_distance(model_.all_pairs(object), "distance to one",
                       [&](auto& script) { manager_.distance(&object, &script, script.on_distance); });
        break;
      case Kind::distance_other:
        check_distance(model_.all_pairs(other_model_), "distance to a manager",
                       [&](auto& script) { manager_.distance(&other_, &script, script.on_distance); });
        break;
      case Kind::margin: {
        const S margin = in_.number<S>();
        manager_.setMargin(margin);
        model_.set_margin(margin);
        break;
      }
      case Kind::source: {
        const auto source = in_.below(2) == 1 ? &flat : nullptr;
        manager_.setBoxSource(source);
        model_.set_source(source);
        break;
      }
      case Kind::move_to_new: {
        fcl_test::Manager<S> moved(std::move(manager_));
        promise(manager_.empty() && fcl_test::collide<S>(manager_).empty(), "a manager that was moved from");
        manager_ = std::move(moved);
        break;
      }
      case Kind::exchange:
        std::swap(manager_, other_);
        std::swap(model_, other_model_);
        break;
    }
    check_objects();
  }

 private:
  using Objects = std::vector<fcl_test::BoxObject<S>*>;

  /// The last values of a byte are for kinds that came later, so that inputs of the corpus keep their meaning.
  Kind read_kind() {
    constexpr auto first_kinds = static_cast<unsigned>(Kind::count);
    const unsigned code = in_.byte();
    return static_cast<Kind>(code < 0xf8 ? code % first_kinds : first_kinds + code % 4);
  }
  static fcl_test::FclBox<S> flat(const fcl_test::Object<S>& object) {
    fcl_test::FclBox<S> box = object.getAABB();
    box.max_[2] = box.min_[2];
    return box;
  }

  static fcl_test::FclBox<S> fcl_box(const BasicAabb<S>& box) {
    return fcl_test::make_box<S>(box.min[0], box.min[1], box.min[2], box.max[0], box.max[1], box.max[2]);
  }
  fcl_test::BoxObject<S>& any() { return scene_[in_.byte() % scene_.size()]; }
  /// Every n-th object from some first one on, and one of them twice.
  const Objects& some() {
    const std::size_t first = in_.byte() % scene_.size(), every = 1 + in_.below(7);
    picked_.clear();
    for (std::size_t i = first; i < scene_.size(); i += every) picked_.push_back(&scene_[i]);
    picked_.push_back(&scene_[first]);
    return picked_;
  }
  static std::vector<fcl_test::Object<S>*> pointers(const Objects& objects) { return {objects.begin(), objects.end()}; }
  static void shift(const Objects& objects, S way) {
    for (auto* const each : objects) {
      fcl_test::FclBox<S> box = each->getAABB();
      box.min_[0] += way;
      box.max_[0] += way;
      each->set(box);
    }
  }

  Script<S> read_script(std::size_t most_calls) {
    Script<S> script;
    const unsigned how = in_.byte();
    if ((how & 1) != 0) script.stop = 1 + in_.two_bytes() % (most_calls + 1);
    script.throws = (how & 2) != 0;
    if ((how & 4) != 0) {
      fcl_test::BoxObject<S>& object = any();
      script.nested = [this, &object] {
        const auto seen = fcl_test::collide<S>(manager_, object);
        const boxstream::detail::DefaultFloatEnvironment environment;
        promise(seen == model_.collide(object), "a query within a query");
      };
    }
    if ((how & 8) != 0) script.limit = in_.number<S>();
    return script;
  }

  template <class Call>
  auto in_some_mood(Call call) {
    const tests::Mood mood(has_moods_ ? mood_++ % tests::Mood::count : 0);
    return call();
  }

  /// Calls in order of registration, of an object of the manager and then of one of `second`.
  Calls by_registration(Calls calls, const fcl_test::Model<S>& second) const {
    const Ranks firsts(model_), seconds(second);
    std::sort(calls.begin(), calls.end(), [&](auto x, auto y) {
      return std::pair(firsts.of(x.first), seconds.of(x.second)) < std::pair(firsts.of(y.first), seconds.of(y.second));
    });
    return calls;
  }

  class Ranks {
   public:
    explicit Ranks(const fcl_test::Model<S>& model) {
      for (const auto* object : model.objects()) of_names_.emplace(fcl_test::name_of(object), of_names_.size());
    }
    /// What is not registered comes last.
    std::size_t of(int name) const {
      const auto found = of_names_.find(name);
      return found == of_names_.end() ? of_names_.size() : found->second;
    }

   private:
    std::unordered_map<int, std::size_t> of_names_;
  };

  template <class Query>
  void check(const fcl_test::Calls& ought, const std::string& what, bool is_ordered, Query query) {
    Script<S> script = read_script(ought.size());
    const bool ended = in_some_mood([&] { return script.run(query); });
    if (!is_ordered) {
      const fcl_test::Calls is = fcl_test::in_any_order(script.calls), all = fcl_test::in_any_order(ought);
      promise(std::adjacent_find(is.begin(), is.end()) == is.end(), what + ": a pair twice");
      promise(std::includes(all.begin(), all.end(), is.begin(), is.end()), what + ": a pair that there is not");
      promise(is.size() == (ended ? all.size() : std::min(script.stop, all.size())), what + ": pairs are missing");
      return;
    }
    const auto difference = fcl_test::same_calls(
        "", "", script.calls,
        ended ? ought : fcl_test::Calls(ought.begin(), ought.begin() + std::min(script.stop, ought.size())));
    promise(difference, what + ": " + difference.message());
  }

  template <class Query>
  void check_distance(typename fcl_test::Model<S>::Near ought, const std::string& what, Query query) {
    Script<S> script = read_script(ought.all.size());
    const bool ended = in_some_mood([&] { return script.run(query); });
    const fcl_test::Calls is = fcl_test::in_any_order(script.calls);
    std::sort(ought.all.begin(), ought.all.end());
    std::sort(ought.certain.begin(), ought.certain.end());
    promise(std::adjacent_find(is.begin(), is.end()) == is.end(), what + ": a pair twice");
    promise(std::includes(ought.all.begin(), ought.all.end(), is.begin(), is.end()),
            what + ": a pair that there is not");
    if (ended && script.limit == std::numeric_limits<S>::infinity())
      promise(std::includes(is.begin(), is.end(), ought.certain.begin(), ought.certain.end()),
              what + ": pairs are missing");
  }

  void check_objects() const {
    std::vector<fcl_test::Object<S>*> objects(3);
    manager_.getObjects(objects);
    promise(objects == model_.objects(), "getObjects");
    promise(manager_.size() == objects.size() && manager_.empty() == objects.empty(), "size");
  }

  Bytes& in_;
  const bool has_moods_, is_ordered_;
  unsigned mood_ = 0;
  fcl_test::Scene<S> scene_;
  fcl_test::Manager<S> manager_, other_;
  fcl_test::Model<S> model_, other_model_;
  Objects picked_;
};

template <class S>
void run(Bytes& in, unsigned flags) {
  tests::InlineExecutor four(4);
  History<S> history(in, (flags & 2) != 0 ? &four : nullptr, (flags & 4) != 0, (flags & 8) != 0);
  for (int i = 0; i < most_ops && !in.empty(); ++i) history.step();
}

}  // namespace
}  // namespace boxstream::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace boxstream::fuzz;
  return run_with_either_scalar(data, size, []<class S>(Bytes& in, unsigned flags) { run<S>(in, flags); });
}
