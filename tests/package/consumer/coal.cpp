// SPDX-License-Identifier: MIT
#include <boxstream/coal.hpp>

struct Count : coal::CollisionCallBackBase {
  int pairs = 0;
  bool collide(coal::CollisionObject*, coal::CollisionObject*) override { return ++pairs < 0; }
};

int main() {
  boxstream::coal::CollisionManager manager;
  Count count;
  manager.collide(&count);
  return count.pairs;
}
