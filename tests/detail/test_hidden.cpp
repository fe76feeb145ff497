// Tests of detail/hidden.hpp.
#include <utility>

#include <rollbem/detail/hidden.hpp>

#include "support/catch.hpp"

using namespace rollbem;

namespace {

// Counts the objects that live, and the copies made.
struct Counted {
    static inline int alive = 0, copies = 0;
    int value = 0;

    Counted() { ++alive; }
    Counted(const Counted& other) : value(other.value) {
        ++alive;
        ++copies;
    }
    Counted& operator=(const Counted&) = delete;
    ~Counted() { --alive; }
};

// Shows only that the type exists.
struct Face {
    struct Internal;
    detail::Hidden<Internal> hidden{};
};

}  // namespace

TEST_CASE("hidden: an object is made at first use, copies are deep, and moves leave none behind", "[hidden]") {
    Counted::copies = 0;
    {
        detail::Hidden<Counted> one;
        const detail::Hidden<Counted> empty = one;
        CHECK(Counted::alive == 0);
        one.made().value = 1;
        detail::Hidden<Counted> two = one;
        two.made().value = 2;
        CHECK(one.made().value == 1);
        CHECK(Counted::copies == 1);
        detail::Hidden<Counted> three = std::move(two);
        CHECK(three.made().value == 2);
        CHECK(Counted::copies == 1);
        CHECK(Counted::alive == 2);
        one = three;
        CHECK(one.made().value == 2);
        CHECK(Counted::alive == 2);
        one = empty;
        CHECK(one.made().value == 0);
        one = std::move(three);
        CHECK(one.made().value == 2);
        CHECK(Counted::alive == 1);
    }
    CHECK(Counted::alive == 0);
}

TEST_CASE("hidden: a source that was moved from can be copied, assigned and used again", "[hidden]") {
    {
        detail::Hidden<Counted> source;
        source.made().value = 1;
        const detail::Hidden<Counted> taken = std::move(source);
        detail::Hidden<Counted> copy = source;  // NOLINT: what a source is good for afterwards
        CHECK(Counted::alive == 1);
        CHECK(copy.made().value == 0);
        detail::Hidden<Counted> assigned;
        assigned.made();
        assigned = std::move(copy);
        copy = source;
        CHECK(source.made().value == 0);
        CHECK(Counted::alive == 3);
        source = taken;
        CHECK(source.made().value == 1);
    }
    CHECK(Counted::alive == 0);
}

TEST_CASE("hidden: owners of a type that is not known yet can be copied and moved", "[hidden]") {
    Face face;
    Face copy = face;
    face = std::move(copy);
    copy = face;
    CHECK(sizeof(face) <= 3 * sizeof(void*));
}

TEST_CASE("hidden: an owner may be given its object", "[hidden]") {
    {
        detail::Hidden<Counted> empty, owner{Counted()};
        CHECK(empty.find() == nullptr);
        REQUIRE(owner.find() != nullptr);
        CHECK(Counted::alive == 1);
        owner.find()->value = 4;
        const detail::Hidden<Counted> copy = owner, moved = std::move(owner);
        CHECK(copy.get().value == 4);
        CHECK(moved.get().value == 4);
        CHECK(copy.find() != moved.find());
        CHECK(owner.find() == nullptr);  // NOLINT(bugprone-use-after-move)
    }
    CHECK(Counted::alive == 0);
}
