// What refers to what. Walks keep their own stack: a chain of a million references must not overflow the program's.
#include "check.h"
#include "scene/match.h"

#include <algorithm>
#include <limits>

namespace nephroid {

namespace {

/// Evaluating textures and flattening groups recurse, so how deep they nest is limited; no sensible scene comes near.
constexpr int kMaxNesting = 512;
constexpr std::uint64_t kMaxCount = std::uint64_t{1} << 31;

using Children = std::vector<std::uint32_t>;

/// The nodes 0 … count-1, each after all its children. `fail_cycle(i)` does not return; `fail_depth(i)` neither.
template <class ChildrenOf, class FailCycle, class FailDepth>
std::vector<std::uint32_t> children_first(std::size_t count, ChildrenOf children_of, FailCycle fail_cycle,
                                          FailDepth fail_depth) {
    enum class State : std::uint8_t { New, Open, Done };
    struct Frame {
        std::uint32_t node;
        Children children;
        std::size_t next = 0;
    };
    std::vector<State> state(count, State::New);
    std::vector<int> height(count, 1);  // of the longest chain below, the node included
    std::vector<std::uint32_t> order;
    std::vector<Frame> stack;
    for (std::uint32_t root = 0; root < count; ++root) {
        if (state[root] != State::New) continue;
        state[root] = State::Open;
        stack.push_back({root, children_of(root)});
        while (!stack.empty()) {
            Frame& top = stack.back();
            if (top.next < top.children.size()) {
                std::uint32_t const child = top.children[top.next++];
                if (state[child] == State::Open) fail_cycle(child);
                if (state[child] == State::Done) continue;
                state[child] = State::Open;
                stack.push_back({child, children_of(child)});
                continue;
            }
            for (std::uint32_t const child : top.children)
                height[top.node] = std::max(height[top.node], height[child] + 1);
            state[top.node] = State::Done;
            order.push_back(top.node);
            stack.pop_back();
        }
    }
    for (std::uint32_t i = 0; i < count; ++i)
        if (height[i] > kMaxNesting) fail_depth(i);
    return order;
}

template <class List, class ChildrenOf>
std::vector<std::uint32_t> check_nesting(Scene const& scene, List const& list, std::string const& kind,
                                         ChildrenOf children_of) {
    return children_first(
        list.size(), children_of,
        [&](std::uint32_t i) {
            scene.fail(list[i].where, "the " + kind + " contains itself: break the cycle of references");
        },
        [&](std::uint32_t i) {
            Check{scene, list[i].where}.limit("the " + kind + " nests more than " +
                                              std::to_string(kMaxNesting) + " deep: flatten it");
        });
}

template <class IdKind, class T>
Children ids_in(T const& x) {
    Children found;
    for_each_leaf(x, [&](auto const& leaf) {
        if constexpr (std::same_as<std::remove_cvref_t<decltype(leaf)>, IdKind>)
            if (leaf.valid()) found.push_back(leaf.value);
    });
    return found;
}

std::uint64_t add(std::uint64_t a, std::uint64_t b) {
    std::uint64_t sum = 0;
    return __builtin_add_overflow(a, b, &sum) ? std::numeric_limits<std::uint64_t>::max() : sum;
}

/// What one look-up costs: a texture or material that names the same child twice evaluates it twice, so that a short
/// chain of such doublings is a long computation at each hit.
constexpr std::uint64_t kMaxEvaluations = 4096;

/// The nodes below and including each one, counted as often as they are reached. `own(i)` is what node i costs by itself.
template <class List, class Own, class ChildrenOf>
std::vector<std::uint64_t> check_evaluations(Scene const& scene, List const& list, std::string const& kind,
                                             std::vector<std::uint32_t> const& children_first_order, Own own,
                                             ChildrenOf children_of) {
    std::vector<std::uint64_t> cost(list.size(), 0);
    for (std::uint32_t const i : children_first_order) {
        cost[i] = own(i);
        for (std::uint32_t const child : children_of(i)) cost[i] = add(cost[i], cost[child]);
        if (cost[i] > kMaxEvaluations)
            Check{scene, list[i].where}.limit(
                "the " + kind + " takes more than " + std::to_string(kMaxEvaluations) +
                " evaluations at each hit, because it names the same ones again and again: simplify it");
    }
    return cost;
}

/// How many primitives a shape becomes.
std::uint64_t primitives(Shape const& shape) {
    return match(
        shape, [](TriangleMesh const& m) { return std::uint64_t{m.triangles.size()}; },
        [](BilinearMesh const& m) { return std::uint64_t{m.patches.size()}; },
        [](LoopSubdivision const& m) { return std::uint64_t{m.triangles.size()} << (2 * m.levels); },
        [](auto const&) { return std::uint64_t{1}; });
}

/// Instances of instances multiply, so their numbers are known before anything is expanded: what one appearance of each
/// group amounts to, children first.
void check_counts(Scene const& scene, std::vector<std::uint32_t> const& children_first_order) {
    struct Count {
        std::uint64_t appearances = 0;  // objects and instances
        std::uint64_t emitters = 0;     // primitives that shine: each of them becomes a light
    };
    std::vector<Count> counts(scene.groups.size());
    std::uint64_t stored = 0;
    SourceLocation last_object;  // the one with which there were too many primitives, or else the last of all
    for (std::uint32_t const g : children_first_order) {
        Count& sum = counts[g];
        for (Object const& object : scene.groups[g].objects) {
            std::uint64_t const n = primitives(object.shape);
            if (stored <= kMaxCount) last_object = object.where;
            stored = add(stored, n);
            sum.appearances = add(sum.appearances, 1);
            if (object.light) sum.emitters = add(sum.emitters, n);
        }
        for (Instance const& instance : scene.groups[g].instances) {
            Count const& part = counts[instance.group.value];
            sum.appearances = add(add(sum.appearances, 1), part.appearances);
            sum.emitters = add(sum.emitters, part.emitters);
        }
    }
    // The place is that of the world's instance with which there are too many.
    auto const culprit = [&](std::uint64_t Count::*member) {
        SourceLocation where = last_object;
        std::uint64_t sum = 0;
        for (Instance const& instance : scene.groups[0].instances) {
            if (sum <= kMaxCount) where = instance.where;
            sum = add(sum, counts[instance.group.value].*member);
        }
        return where;
    };
    auto const limit = [&](std::uint64_t n, SourceLocation where, char const* what, char const* remedy) {
        if (n > kMaxCount)
            Check{scene, where}.limit(std::string("the scene has more than 2^31 ") + what + ": " + remedy);
    };
    limit(stored, last_object, "primitives", "simplify its meshes, or instance them");
    limit(counts[0].appearances, culprit(&Count::appearances),
          "objects once its instances are multiplied out", "use fewer instances");
    limit(counts[0].emitters, culprit(&Count::emitters),
          "shining primitives once its instances are multiplied out", "use fewer instances of lights");
}

}  // namespace

void check_graphs(Scene const& scene) {
    auto const below_texture = [&](std::uint32_t i) { return ids_in<TextureId>(scene.textures[i].kind); };
    auto const textures = check_nesting(scene, scene.textures, "texture", below_texture);
    auto const costs = check_evaluations(
        scene, scene.textures, "texture", textures, [](std::uint32_t) { return std::uint64_t{1}; },
        below_texture);
    check_texture_types(scene, textures);
    auto const below_material = [&](std::uint32_t i) { return ids_in<MaterialId>(scene.materials[i].kind); };
    auto const own_cost = [&](std::uint32_t i) {
        std::uint64_t sum = 1;
        for (std::uint32_t const t : ids_in<TextureId>(scene.materials[i])) sum = add(sum, costs[t]);
        return sum;
    };
    check_evaluations(scene, scene.materials, "material",
                      check_nesting(scene, scene.materials, "material", below_material), own_cost,
                      below_material);
    auto const order = check_nesting(scene, scene.groups, "group", [&](std::uint32_t i) {
        Children found;
        for (Instance const& instance : scene.groups[i].instances) found.push_back(instance.group.value);
        return found;
    });
    check_counts(scene, order);
}

}  // namespace nephroid
