// SPDX-License-Identifier: MIT
#include "forks.hpp"

#include <mutex>
#include <stdexcept>

#include <pthread.h>

namespace boxstream::threads {

namespace {

/// Locked from before a fork until after it: the child gets a list that no other thread was changing.
struct Watchers {
  std::mutex mutex;
  std::list<SeesForks*> list;

  Watchers();
};

/// Never destroyed: a process may fork until its last moment.
Watchers& watchers() {
  static Watchers& all = *new Watchers;
  return all;
}

void before() {
  watchers().mutex.lock();
  for (SeesForks* each : watchers().list) each->before_fork();
}

void in_parent() {
  for (SeesForks* each : watchers().list) each->after_fork_in_parent();
  watchers().mutex.unlock();
}

void in_child() {
  for (SeesForks* each : watchers().list) each->after_fork_in_child();
  watchers().mutex.unlock();
}

Watchers::Watchers() {
  if (pthread_atfork(&before, &in_parent, &in_child) != 0)
    throw std::runtime_error("boxstream: the system keeps no more functions for forks");
}

}  // namespace

ForkWatch::ForkWatch(SeesForks& watcher) {
  const std::lock_guard lock(watchers().mutex);
  place_ = watchers().list.insert(watchers().list.end(), &watcher);
}

ForkWatch::~ForkWatch() {
  const std::lock_guard lock(watchers().mutex);
  watchers().list.erase(place_);
}

}  // namespace boxstream::threads
