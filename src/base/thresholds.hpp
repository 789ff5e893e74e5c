// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

namespace boxstream::detail {

/// Numbers of boxes, pairs or updates above which the library takes another code path. Only times and orders depend on
/// them: the set of pairs is the same with any. Products use the values below; fuzzers and some tests are compiled with
/// small ones, with which a few dozen boxes reach every path (the target `boxstream_small_thresholds`).
struct Thresholds {
  // A batch: which way it goes.

  /// Up to this number of boxes of one set, comparing all with all takes less time than what saves most of the
  /// comparisons.
  std::size_t most_small = 384;
  /// One of them in so many tells whether bytes part them, and so many that seem to overlap say nothing.
  std::size_t others_of_try = 16, seeming_by_chance = 4;
  /// More of them are compared by bytes first.
  std::size_t most_at_once = 64;
  /// Sets of up to this number of boxes are compared several at once. Not more, for their pairs are bits of a word.
  std::size_t most_tiny = 11;
  /// To compare a box with up to so many takes no longer than to see whether it can be culled: a tenth of a nanosecond
  /// for each. With up to `few`, if that is not many more comparisons than it takes to prepare the culling.
  std::size_t fewest = 19, few = 64;
  std::uint64_t compared_before_culling = 150000;
  /// Two sets that are not disjoint, one of up to this many boxes, are compared one with all, if that is up to so many
  /// comparisons for each box of both: a join takes no less.
  std::size_t most_few = 320;
  std::uint64_t compared_of_box = 128;

  // A node: whether it is planned, and whether it is cut as planned.

  /// Up to here a plan takes longer than the comparisons it saves, unless all boxes overlap on the first axis.
  std::size_t no_plan_below = 160;
  /// Copies of a box, on average, beyond which a plan that foresaw fewer is made simpler.
  std::size_t most_unforeseen_copies = 4;
  /// A child planned as a leaf gets a plan of its own if it is larger than planned by this factor: a power of two, so
  /// that the product is exact where callers have traps.
  double leaf_tolerance = 2.0;
  /// Copies of a box that all leaves together may hold.
  std::uint64_t most_copies = 16;
  /// The cube of the bits of a search's size, over this, is how often a sweep may compare each of its boxes.
  std::uint64_t share_of_tests = 4;
  /// A sweep over budget may go on while it finds a pair in so many comparisons.
  std::uint64_t tests_per_pair = 8;
  /// What is over budget is cut at medians down to this size: up to here comparing all with all costs less than what a
  /// cut moves.
  std::size_t bounded_leaf = 128;
  /// The paper's tree as a method: comparisons of a scan for each of its boxes above which it is cheaper to cut, and by
  /// what factor a sample may have been wrong about them before what is left goes to the tree with the bound.
  std::uint64_t tests_of_cut = 128, wrong_by = 16;
  /// Boxes of a sample that tells how many overlap, of small nodes and of those from a size on. At most 256.
  std::size_t overlap_sample = 64, large_overlap_sample = 256, large_node = 16384;
  /// Tasks that the upper part of that tree is cut into, for each thread.
  std::size_t subtrees_of_thread = 4;

  // A plan: what it is made from. Prices are in batch/cuts/plan.cpp but for those without which few boxes are never
  // cut.

  /// Each doubling of a leaf beyond makes ordering it dearer; up to here no cut pays.
  std::size_t boxes_in_cache = 1024;
  /// Up to here one level of cuts is as good as two.
  std::size_t one_level_below = 8192;
  /// A larger leaf, which one thread does and which takes three times as much memory a box as a cut, has to be clearly
  /// cheaper.
  std::size_t most_in_leaf = 65536;
  /// One box against a block.
  double compare_block = 1.7;
  /// Calls and the bucket table of a leaf.
  double make_leaf = 300.0;
  /// Boxes of a sample: at least, for the axis of a sweep, for one level of cuts at most and for two at least.
  std::size_t least_sample = 16, sample_for_axis = 24, sample_for_level = 64;
  /// How many boxes of the sample are compared with those behind them.
  std::size_t boxes_for_pairs = 128;
  /// Large boxes, as a share, that are worth a try not to take them out.
  double most_copied = 0.03;

  // A sweep.

  /// Boxes per bucket to aim for: a window wastes about one bucket.
  std::size_t boxes_per_bucket = 4;
  /// Comparisons per box within its own bucket beyond which sorting is cheaper: buckets sixteen times as full.
  std::size_t most_own_bucket_tests = 32;
  /// Hits that are noted before the close look at them.
  std::size_t most_hits = 512;
  /// Blocks that the window of one may have before it is asked whether its boxes reach equally far.
  std::size_t longest_window = 12;
  /// Boxes swept to a dense hit, below which columns pay.
  std::size_t hits_for_columns = 16;
  /// Boxes swept to a pair whose keys leave a doubt, below which it pays to read all bits of a leaf's boxes; and the
  /// pairs that tell.
  std::size_t boxes_for_doubt = 4, least_doubts = 16;
  /// Pairs of the first batch that a caller gets, and of later ones: 8 KiB, which stay in L1 and on a small stack.
  std::size_t first_batch = 64, batch = 1024;

  // Boxes left out before a search: those of other sets that are far away, and those that filters refuse.

  /// Marking a set that is smaller by this factor takes little time, so it is tried.
  std::size_t much_smaller = 4;
  /// Finding out whether it pays takes 10 microseconds then.
  std::size_t cull_much_smaller = 1536;
  /// Otherwise it takes 80 to 120 microseconds. To join that many boxes, with one set that large, takes at least 2
  /// milliseconds, and 10 with both.
  std::size_t cull_equals = 98304;
  /// For the estimate, one block of a set in this many is marked, in a grid of fewer cells so that a part fills it.
  std::size_t cull_part = 32;
  unsigned cells_to_try = 32;
  /// Cells should stay in cache. A set that fills space needs smaller cells, and testing few other boxes is fast.
  std::size_t few_cells_below = std::size_t{1} << 15, many_cells_from = std::size_t{1} << 19;
  /// Boxes of a sample in the range of the other set, and how many of them must overlap their own set: with fewer the
  /// estimate means nothing.
  double least_inside = 32, least_found = 8;
  /// Finding the classes that accept each other takes time quadratic in their number.
  std::size_t least_boxes_of_class = 64;
  std::size_t sample_of_filters = 128;
  /// What a join within a class, and between classes, costs to begin, in boxes.
  std::uint64_t begin_within = 32, begin_between = 256;
  /// Records of more boxes than this do not stay in a cache.
  std::uint64_t records_in_cache = 65536;

  // Threads.

  /// A thread is to have at least that many boxes: it takes longer to share fewer, and scratch memory must not grow
  /// with threads that have nothing to do.
  std::size_t boxes_of_thread = 1000;
  /// Nodes of fewer boxes are left to one thread, where others take 50 microseconds to start.
  std::uint64_t boxes_of_sleepers = 16384;
  /// Boxes that are counted and copied together: so many that the time to hand them out does not show.
  std::size_t boxes_of_range = 512;
  /// A task of many small searches has the least boxes that are shared over the first; a thread has at most the second.
  std::size_t tasks_of_share = 8, tasks_of_thread = 16;
  /// A box or a pair takes about 4 ns in a phase of an update, and a box 20 in a search.
  std::size_t things_of_box = 4;
  /// A tenth of a millisecond of probes: smaller tasks cost more than they save.
  std::size_t probes_of_task = 1024;
  /// Pairs that wait together: 64 KiB with the rest, taken seldom, and no more than an L2 holds.
  std::size_t waiting_pairs = 8190;
  /// Pairs that the tasks of a stream may hold back together, beside one for each box: 16 MiB, so that what a task of a
  /// small search with very many pairs finds still fits.
  std::size_t most_waiting = std::size_t{1} << 21;

  // A world: which way an update goes.

  /// Up to this number of proxies, tombstones included, boxes are columns too, to be compared by rows of bits. A world
  /// that has had more is small again at three quarters of that.
  std::size_t few_proxies = 384;
  /// While rows or a batch of few cost less than so many boxes in a batch, nothing else is looked at.
  std::size_t cheap_of_few = 96;
  /// So few are scanned by every ray but one that `is_long` on an axis. With more an index is brought up to date by the
  /// next one after so many.
  std::size_t always_scanned = 192;
  std::uint32_t scans_before_index = 64;
  /// Rooms that hold for so many updates have paid.
  unsigned rooms_pay = 4;

  // A world: candidates kept from update to update.

  /// Margins are planned for at most this many updates.
  unsigned most_planned = 64;
  /// Motion is measured once in this many updates.
  std::uint32_t measure_interval = 8;
  /// Boxes whose motion is sampled.
  std::size_t least_sampled = 16, most_sampled = 256;
  /// With fewer boxes, following the common step costs more than it saves.
  std::size_t least_followed = 128;
  /// Number of boxes that fits the nearest caches, and that fits any.
  std::size_t in_near_caches = 32768, in_caches = 262144;
  /// Up to this many exits scan all fat boxes; more build an index.
  std::size_t most_scans = 64;
  /// Candidates that are kept, for a proxy and for a pair: 8 bytes each. Fat boxes of long thin boxes can all overlap
  /// where no boxes do.
  std::size_t candidates_of_proxy = 8, candidates_of_pair = 4;
  /// Pairs of a proxy that began or ended elsewhere, beyond which candidates are dropped.
  std::size_t changed_of_proxy = 8;
  /// Updates without candidates after they have not paid; four times as many after each further failure.
  unsigned first_wait = 16, most_failures = 4;

  // A world: its pairs.

  /// Inserting into a side list moves what follows; folding copies the whole array. At this length the first still
  /// costs less than a microsecond, and the second is paid once in this many calls.
  std::size_t longest_side_list = 1024;
  /// The same for updates of few proxies, which look through the list: a 256th of a fold is less than one change of a
  /// pair among few thousands costs.
  std::size_t longest_side_list_of_updates = 256;
  /// Ranks whose pairs are looked for one by one: a vector is compared in the time of one look-up.
  std::size_t listed_one_by_one = 8;
  /// Pairs of a rank up to which those of a search of all are sorted into lists: with more it takes longer than to look
  /// each up, and memory for all of them.
  std::size_t merged_of_rank = 4;
  /// Where fewer than one pair in this many comes or goes, what is before it stays where it is; otherwise runs are too
  /// short to be worth a call.
  std::size_t pairs_of_event = 32;
  /// A branch or two are mispredicted for each pair that comes or goes, which for more than one in so many ranks costs
  /// more than to find all starts again.
  std::size_t ranks_of_event = 16;
  /// Fewer keys than this are sorted by comparing before the counters of one pass are even cleared.
  std::size_t few_keys = 64;
  /// A pass of sorting writes to 2^bits places in turn; with more than this many they no longer stay in the nearest
  /// cache.
  unsigned most_digit_bits = 10;
  /// Pairs that a filter is asked about together, in their order: those that it refuses take no more memory than that.
  std::size_t asked_at_once = 8192;
  /// So few boxes are probed for one by one: for many at once there is more to set up.
  std::size_t probed_alone = 8;

  /// With few proxies a scan is faster than a refresh of the index.
  std::size_t scanned_for_one = 256;
  /// A room that holds a few times pays for a scan, where there is no index.
  std::size_t scanned_for_rooms = 4096;
  /// Dead proxies that are left in their places, beside two for each live one.
  std::size_t most_dead = 32;
  /// Pairs or boxes that are worked on together, on the stack.
  std::size_t portion = 256;

  // The index of queries, and its walks.

  /// Samples per choice of an axis or of a pivot: enough to tell which axis spreads most and to cut near the place
  /// wanted, cheap beside the pass over the range that follows.
  std::size_t pivot_samples = 32;
  /// Below this the library's selection is as fast.
  std::size_t few_centres = 48;
  /// Every query scans the tail, and every insert pays a share of the next rebuild: n log n over the length of the
  /// tail. The sum is least for a tail that grows with the square root of n.
  std::size_t least_tail = 64, tail_of_root = 4;
  /// Visits of a batch that go down together.
  std::size_t visits = 128;
  /// Planes, and nearest boxes, that are kept on the stack.
  std::size_t few_planes = 16, few_nearest = 32;

  // Sets of objects.

  /// Up to here pairs of near objects are compared one by one.
  std::size_t near_tests = 6;
  /// Up to here all boxes are compared with all in blocks. No more than FewPairs::most.
  std::size_t few_objects = 128;
  std::size_t few_near_objects = 64;
  /// What is looked at for a pair that a query of near ones begins with: blocks of one set, or those opened of two.
  std::size_t first_near_blocks = 8, first_near_opened = 16;
  /// Up to here an index of objects is a list.
  std::size_t few_without_tree = 24;
  /// For larger sets, where a scan takes thousands of times as long as a query of the index, scans are given up sooner.
  std::uint32_t small_set = 16384;
  /// Gaps that objects which have left may leave in a table, beside one for two that are there.
  std::size_t most_gaps = 16;
  /// Tests between two sets up to which all rows are tried one by one.
  std::uint64_t few_tests = 4096;
  /// Pairs that are held, and more for each place: finding them again row by row needs memory for the boxes only.
  std::uint64_t held_pairs = std::uint64_t{1} << 20, held_pairs_of_place = 32;
};

/// With these a few dozen boxes are cut along two axes, by four threads, over budget, and so on; drift, leave their fat
/// boxes, and have them and the index rebuilt.
inline constexpr Thresholds small_thresholds = {
    .most_small = 12,
    .others_of_try = 2,
    .seeming_by_chance = 1,
    .most_at_once = 6,
    .most_tiny = 8,
    .fewest = 2,
    .few = 3,
    .compared_before_culling = 40,
    .most_few = 8,
    .no_plan_below = 6,
    .most_unforeseen_copies = 2,
    .leaf_tolerance = 1,
    .most_copies = 6,
    .share_of_tests = 64,
    .tests_per_pair = 1,
    .bounded_leaf = 4,
    .tests_of_cut = 2,
    .wrong_by = 2,
    .overlap_sample = 4,
    .large_overlap_sample = 8,
    .large_node = 24,
    .subtrees_of_thread = 2,
    .boxes_in_cache = 8,
    .one_level_below = 16,
    .most_in_leaf = 64,
    .compare_block = 60,
    .make_leaf = 1,
    .least_sample = 4,
    .sample_for_axis = 6,
    .sample_for_level = 8,
    .boxes_for_pairs = 4,
    .most_copied = 0.3,
    .boxes_per_bucket = 2,
    .most_own_bucket_tests = 4,
    .most_hits = 32,
    .longest_window = 1,
    .hits_for_columns = 2,
    .boxes_for_doubt = 8,
    .least_doubts = 2,
    .first_batch = 4,
    .batch = 16,
    .much_smaller = 2,
    .cull_much_smaller = 12,
    .cull_equals = 16,
    .cull_part = 2,
    .cells_to_try = 8,
    .few_cells_below = 24,
    .many_cells_from = 48,
    .least_inside = 2,
    .least_found = 1,
    .least_boxes_of_class = 2,
    .sample_of_filters = 4,
    .begin_within = 1,
    .begin_between = 4,
    .records_in_cache = 32,
    .boxes_of_thread = 4,
    .boxes_of_sleepers = 16,
    .boxes_of_range = 64,
    .tasks_of_share = 4,
    .tasks_of_thread = 2,
    .things_of_box = 1,
    .probes_of_task = 2,
    .waiting_pairs = 14,
    .most_waiting = 16,
    .few_proxies = 6,
    .cheap_of_few = 4,
    .always_scanned = 3,
    .scans_before_index = 2,
    .rooms_pay = 2,
    .most_planned = 8,
    .measure_interval = 2,
    .least_sampled = 4,
    .most_sampled = 8,
    .least_followed = 4,
    .in_near_caches = 24,
    .in_caches = 60,
    .most_scans = 2,
    .candidates_of_proxy = 2,
    .candidates_of_pair = 2,
    .changed_of_proxy = 1,
    .first_wait = 1,
    .most_failures = 2,
    .longest_side_list = 3,
    .longest_side_list_of_updates = 4,
    .listed_one_by_one = 2,
    .merged_of_rank = 1,
    .pairs_of_event = 4,
    .ranks_of_event = 2,
    .few_keys = 4,
    .most_digit_bits = 3,
    .asked_at_once = 8,
    .probed_alone = 2,
    .scanned_for_one = 8,
    .scanned_for_rooms = 64,
    .most_dead = 2,
    .portion = 64,
    .pivot_samples = 8,
    .few_centres = 12,
    .least_tail = 8,
    .tail_of_root = 1,
    .visits = 8,
    .few_planes = 2,
    .few_nearest = 2,
    .near_tests = 4,
    .few_objects = 16,
    .few_near_objects = 16,
    .first_near_blocks = 2,
    .first_near_opened = 2,
    .few_without_tree = 4,
    .small_set = 16,
    .most_gaps = 2,
    .few_tests = 16,
    .held_pairs = 16,
    .held_pairs_of_place = 1,
};

#ifdef BOXSTREAM_SMALL_THRESHOLDS
inline constexpr Thresholds thresholds = small_thresholds;
#else
inline constexpr Thresholds thresholds{};
#endif

}  // namespace boxstream::detail
