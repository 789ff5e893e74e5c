// SPDX-License-Identifier: MIT
#include "inputs/recipe.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "inputs/bad_recipes.hpp"
#include "peers/ours.hpp"
#include "peers/pair_hash.hpp"
#include "peers/plain.hpp"

namespace boxstream::bench {
namespace {

TEST(Recipes, GiveAsManyValidBoxesAsTheySayAndTheSameEachTime) {
  batches::Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Recipe recipe = random_recipe(100 + static_cast<std::size_t>(i), random);
    const std::vector<Aabb> boxes = make_boxes(recipe);
    ASSERT_EQ(boxes.size(), recipe.n);
    ASSERT_TRUE(std::all_of(boxes.begin(), boxes.end(), [](const Aabb& box) { return is_valid(box); }));
    ASSERT_EQ(boxes, make_boxes(recipe));
  }
}

// A recipe that was found is worth nothing if its text makes other boxes.
TEST(Recipes, TextMakesTheSameBoxesAgain) {
  batches::Random random(2);
  Recipe recipe = random_recipe(300, random);
  std::set<std::string> texts;
  for (int i = 0; i < 300; ++i) {
    const std::string text = to_text(recipe);
    texts.insert(text);
    const Recipe again = parse_recipe(text);
    ASSERT_EQ(to_text(again), text);
    ASSERT_EQ(make_boxes(again), make_boxes(recipe)) << text;
    recipe = mutated(recipe, random);
  }
  EXPECT_GT(texts.size(), 200u);
}

TEST(Recipes, KnownBadOnesAreWrittenAsTheyArePrinted) {
  for (const char* text : bad_recipes) EXPECT_EQ(to_text(parse_recipe(text)), text);
}

TEST(Recipes, OnKnownBadOnesOursAndTheSweepAgree) {
  const std::unique_ptr<Peer> sweep = make_sweep();
  const std::unique_ptr<OurMethod> detector = make_detector(nullptr);
  for (const char* text : bad_recipes) {
    const std::vector<Aabb> boxes = make_boxes(parse_recipe(text));
    std::vector<Pair> expected, pairs;
    sweep->find_pairs(boxes, expected);
    detector->find_pairs(boxes, pairs);
    EXPECT_EQ(summarize(pairs), summarize(expected)) << text;
  }
}

TEST(Recipes, OrdersAreKept) {
  Recipe recipe;
  recipe.n = 100;
  recipe.axis = 1;
  recipe.parts.emplace_back();
  recipe.order = Order::ascending;
  std::vector<Aabb> boxes = make_boxes(recipe);
  EXPECT_TRUE(
      std::is_sorted(boxes.begin(), boxes.end(), [](const Aabb& a, const Aabb& b) { return a.min[1] < b.min[1]; }));
  recipe.order = Order::shuffled;
  boxes = make_boxes(recipe);
  EXPECT_FALSE(
      std::is_sorted(boxes.begin(), boxes.end(), [](const Aabb& a, const Aabb& b) { return a.min[1] < b.min[1]; }));
}

TEST(Recipes, WhatIsNoRecipeIsRefused) {
  for (const char* text : {"", "n=10", "n=10;place=nowhere", "n=0;weight=1", "n=10;weight=0", "n=10;size=1:2",
                           "n=10;size=1:2:3:4", "n=10;decades=nan", "m=10;weight=1", "n=10x;weight=1"})
    EXPECT_THROW(parse_recipe(text), std::invalid_argument) << text;
}

}  // namespace
}  // namespace boxstream::bench
