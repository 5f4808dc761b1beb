#include "scene/suggestion.hpp"
#include "scene/polygon_check.hpp"
#include "tests/catch.hpp"

using namespace vitrum;

TEST_CASE("edit distance counts insertions, deletions, replacements and swaps", "[scene]") {
  using scene::edit_distance;
  CHECK(edit_distance("", "abc") == 3);
  CHECK(edit_distance("step", "step") == 0);
  CHECK(edit_distance("stp", "step") == 1);
  CHECK(edit_distance("setp", "step") == 1);
  CHECK(edit_distance("Step", "step") == 0);
  CHECK(edit_distance("kitten", "sitting") == 3);
}

TEST_CASE("only near words are suggested", "[scene]") {
  const std::vector<std::string> words{"k", "m", "toughness", "rate"};
  CHECK(scene::nearest("toughnes", words) == "toughness");
  CHECK(scene::nearest("ratio", words) == "rate");
  CHECK(scene::nearest("n", words).empty());
  CHECK(scene::nearest("something", words).empty());
  CHECK(scene::nearest(std::string(100'000, 'x'), words).empty());
}

TEST_CASE("simple polygons of either orientation are accepted", "[scene]") {
  using scene::polygon_fault;
  const std::vector<Vector2> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, reversed(square.rbegin(), square.rend());
  CHECK(polygon_fault(square).empty());
  CHECK(polygon_fault(reversed).empty());
  CHECK(polygon_fault(std::vector<Vector2>{{0, 0}, {2, 0}, {1, 0.5}, {2, 2}, {0, 2}}).empty());
  CHECK(polygon_fault(std::vector<Vector2>{{0, 0}, {1, 0}, {2, 0}, {2, 2}})
            .empty());  // a vertex on a straight side
  CHECK_FALSE(
      polygon_fault(std::vector<Vector2>{{0, 0}, {2, 0}, {2, 2}, {1, 0}, {0, 2}}).empty());  // touches itself
}
