// SPDX-License-Identifier: MIT
//
// A World as bytes, all numbers little-endian:
//
//   0  "boxworld"
//   8  uint32  version, 1; bytes of a coordinate, 4 or 8; 1 if filters are sticky; 1 for the hybrid method; its cutoff;
//              0, for alignment
//  32  uint64  slots, proxies, pairs, pairs that began, pairs that ended, checksum of all other bytes
//  80          of each slot, uint32: the last generation that was given out
//              of each proxy, in order of creation: ids; boxes; groups and masks; numbers of the caller's
//              ids of pairs, of those that began, and of those that ended
//
// Ids are made anew by creating and destroying in the same order: a slot is used again as often as it was.

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <tuple>

#include "world.hpp"

namespace boxstream::python {

namespace {

constexpr char magic[] = "boxworld";
constexpr std::uint32_t version = 1;

struct Header {
  char magic[8];
  std::uint32_t version, bytes, sticky, hybrid, cutoff, zero;
  std::uint64_t slots, proxies, pairs, begun, ended, checksum;
};
static_assert(sizeof(Header) == 80);

[[noreturn]] void refuse(const char* why) {
  throw py::value_error(std::string("these bytes are not of a World: ") + why);
}

/// Of a World's bytes; those of the checksum itself count as zeros.
std::uint64_t checksum_of(Span<const std::uint8_t> bytes, Signals& signals) {
  constexpr std::size_t own = offsetof(Header, checksum), portion = 1 << 20;
  std::uint64_t sum = bytes.size();
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (i % portion == 0) signals.check();
    const bool is_own = i >= own && i < own + sizeof(Header::checksum);
    sum = (sum ^ (is_own ? 0 : bytes[i])) * 0x100000001b3;
  }
  return sum;
}

std::uint64_t key_of(ProxyId id) {
  return std::uint64_t{id.generation} << 32 | id.slot;
}

/// Everything of a World.
template <class S>
struct Contents {
  Header header{};
  std::vector<std::uint32_t> generations;
  std::vector<ProxyId> ids;
  std::vector<BasicAabb<S>> boxes;
  std::vector<Filter> filters;
  std::vector<std::uint64_t> users;
  std::vector<ProxyPair> pairs, begun, ended;

  auto arrays() { return std::tie(generations, ids, boxes, filters, users, pairs, begun, ended); }

  std::size_t bytes() {
    std::size_t sum = sizeof(Header);
    std::apply([&](auto&... each) { ((sum += each.size() * sizeof each[0]), ...); }, arrays());
    return sum;
  }
};

/// Creates what a World had in a new one.
template <class S>
class Restoring {
 public:
  Restoring(BasicWorld<S>& world, const Contents<S>& contents, Signals& signals)
      : world_(world), contents_(contents), signals_(signals) {
    for (const ProxyPair& pair : contents.pairs) held_.push_back({key_of(pair.a), key_of(pair.b)});
    std::sort(held_.begin(), held_.end());
  }

  void run() {
    for (std::size_t i = 0; i < contents_.ids.size(); ++i) create(i);
    while (stand_ins_.size() < contents_.generations.size()) add_stand_in();
    for (std::uint32_t slot = 0; slot < stand_ins_.size(); ++slot)
      if (stand_ins_[slot]) {
        use_up_to(slot, contents_.generations[slot]);
        world_.destroy(stand_ins_[slot]);
      }
    update();
    if (contents_.header.sticky != 0) {  // these held pairs that these filters refuse
      for (std::size_t i = 0; i < contents_.ids.size(); ++i) world_.set_filter(contents_.ids[i], contents_.filters[i]);
      update();
    }
    update();  // nothing has begun or ended in it
    if (world_.pair_count() != held_.size()) refuse("pairs that do not touch");
  }

 private:
  void create(std::size_t i) {
    const ProxyId id = contents_.ids[i];
    if (id.slot >= contents_.generations.size() || contents_.generations[id.slot] != id.generation)
      refuse("an id of no slot");
    if (id.generation == 1) {
      while (stand_ins_.size() < id.slot) add_stand_in();
      stand_ins_.emplace_back();
    } else {
      while (stand_ins_.size() <= id.slot) add_stand_in();
      if (!stand_ins_[id.slot]) refuse("an id that is there twice");
      use_up_to(id.slot, id.generation - 1);
      world_.destroy(std::exchange(stand_ins_[id.slot], ProxyId()));
    }
    const Filter filter = contents_.header.sticky != 0 ? Filter() : contents_.filters[i];
    if (world_.create(contents_.boxes[i], filter, contents_.users[i]) != id) refuse("ids in an order that cannot be");
    count();
  }

  /// Without a valid box, it has no pairs.
  ProxyId stand_in() {
    count();
    return world_.create({{1, 1, 1}, {0, 0, 0}});
  }

  void add_stand_in() {
    if (stand_ins_.size() >= contents_.generations.size()) refuse("an id of no slot");
    stand_ins_.push_back(stand_in());
  }

  void use_up_to(std::uint32_t slot, std::uint32_t generation) {
    ProxyId& id = stand_ins_[slot];
    while (id.generation < generation) {
      world_.destroy(id);
      const ProxyId next = stand_in();
      if (next.slot != slot) refuse("generations that cannot be");
      id = next;
    }
  }

  /// What has been destroyed takes memory until an update.
  void count() {
    signals_.check();
    if (++created_ % 1'000'000 == 0) update();
  }

  void update() {
    world_.update([&](ProxyId a, ProxyId b) {
      signals_.check();
      return std::binary_search(held_.begin(), held_.end(), std::pair(key_of(a), key_of(b)));
    });
  }

  BasicWorld<S>& world_;
  const Contents<S>& contents_;
  Signals& signals_;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> held_;
  std::vector<ProxyId> stand_ins_;  // of each slot so far; null where a proxy is
  std::size_t created_ = 0;
};

}  // namespace

void PyWorld::Journal::reserve(std::size_t more) {
  const auto grow = [more](auto& array) {
    if (array.capacity() - array.size() < more) array.reserve(std::max(array.size() + more, 2 * array.size()));
  };
  grow(created);
  grow(generations);
}

void PyWorld::Journal::note(Span<const ProxyId> ids) noexcept {
  for (const ProxyId id : ids) {
    if (id.slot >= generations.size()) generations.resize(id.slot + std::size_t{1});
    generations[id.slot] = id.generation;
  }
  created.insert(created.end(), ids.begin(), ids.end());
}

py::bytes PyWorld::save() {
  const auto saved = read_long([&]<class S>(const BasicWorld<S>& world, Signals& signals) {
    if (changes_ != 0)
      throw std::runtime_error("a World can be saved after update(): its boxes or filters have changed since");
    Contents<S> all;
    all.generations = journal_.generations;
    for (const ProxyId id : journal_.created) {
      signals.check();
      if (!world.contains(id)) continue;
      all.ids.push_back(id);
      all.boxes.push_back(world.box(id));
      all.filters.push_back(world.filter(id));
      all.users.push_back(world.user(id));
    }
    all.pairs = pairs_in(world, signals);
    all.begun = begun_in(world);
    all.ended = ended_in(world);
    all.header = {{},
                  version,
                  sizeof(S),
                  options_.sticky_filters,
                  options_.method == Method::hybrid,
                  options_.cutoff,
                  0,
                  all.generations.size(),
                  all.ids.size(),
                  all.pairs.size(),
                  all.begun.size(),
                  all.ended.size(),
                  0};
    std::memcpy(all.header.magic, magic, sizeof all.header.magic);
    std::vector<std::uint8_t> bytes(all.bytes());
    std::uint8_t* to = bytes.data() + sizeof(Header);
    const auto put = [&](const auto& array) {
      if (!array.empty()) std::memcpy(to, array.data(), array.size() * sizeof array[0]);
      to += array.size() * sizeof array[0];
    };
    std::apply([&](const auto&... each) { (put(each), ...); }, all.arrays());
    std::memcpy(bytes.data(), &all.header, sizeof(Header));
    all.header.checksum = checksum_of(bytes, signals);
    std::memcpy(bytes.data(), &all.header, sizeof(Header));
    return bytes;
  });
  return py::bytes(reinterpret_cast<const char*>(saved.data()), saved.size());
}

namespace {

/// Throws unless the bytes are as many as they say, and what was saved.
Header header_of(Span<const std::uint8_t> bytes, Signals& signals) {
  Header header;
  if (bytes.size() < sizeof header || std::memcmp(bytes.data(), magic, sizeof header.magic) != 0)
    refuse("they do not begin as one");
  std::memcpy(&header, bytes.data(), sizeof header);
  if (header.version != version) refuse("another version");
  if (header.bytes != 4 && header.bytes != 8) refuse("coordinates of an unknown type");
  // Each of these is of at least 4 bytes: their sum cannot overflow.
  for (const std::uint64_t count : {header.slots, header.proxies, header.pairs, header.begun, header.ended})
    if (count > bytes.size() / 4) refuse("cut off");
  if (checksum_of(bytes, signals) != header.checksum) refuse("they have changed");
  return header;
}

template <class S>
Contents<S> contents_of(const Header& header, Span<const std::uint8_t> bytes) {
  Contents<S> all;
  all.header = header;
  const std::uint64_t counts[] = {header.slots,   header.proxies, header.proxies, header.proxies,
                                  header.proxies, header.pairs,   header.begun,   header.ended};
  const std::uint64_t* count = counts;
  std::apply([&](auto&... each) { (each.resize(*count++), ...); }, all.arrays());
  if (all.bytes() != bytes.size()) refuse("cut off");
  const std::uint8_t* from = bytes.data() + sizeof header;
  const auto take = [&](auto& array) {
    if (!array.empty()) std::memcpy(array.data(), from, array.size() * sizeof array[0]);
    from += array.size() * sizeof array[0];
  };
  std::apply([&](auto&... each) { (take(each), ...); }, all.arrays());
  return all;
}

}  // namespace

std::unique_ptr<PyWorld> PyWorld::load(const py::bytes& saved, py::handle executor) {
  char* data = nullptr;
  py::ssize_t size = 0;
  if (PyBytes_AsStringAndSize(saved.ptr(), &data, &size) != 0) throw py::error_already_set();
  const Span<const std::uint8_t> bytes(reinterpret_cast<const std::uint8_t*>(data), static_cast<std::size_t>(size));
  const Header header = without_lock([&](const Unlocked& unlocked) {
    Signals signals(unlocked);
    return header_of(bytes, signals);
  });
  WorldOptions options;
  options.sticky_filters = header.sticky != 0;
  options.method = header.hybrid != 0 ? Method::hybrid : Method::planned;
  options.cutoff = header.cutoff;
  auto loaded =
      std::make_unique<PyWorld>(dtype_of(header.bytes == 4 ? Scalar::float32 : Scalar::float64), executor, options);
  without_lock([&](const Unlocked& unlocked) {
    Signals signals(unlocked);
    std::visit(
        [&]<class S>(BasicWorld<S>& world) {
          Contents<S> contents = contents_of<S>(header, bytes);
          Restoring<S>(world, contents, signals).run();
          loaded->journal_ = {std::move(contents.ids), std::move(contents.generations)};
          loaded->last_ = LastEvents{std::move(contents.begun), std::move(contents.ended)};
        },
        loaded->worlds_);
  });
  return loaded;
}

}  // namespace boxstream::python
