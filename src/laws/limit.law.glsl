// Springs with a limit in the implicit step: energy, force, and stiffness along and across the spring.
//
//   E(l) = 1/2 k e^2 + 1/2 K max(0, e - s l0 + a)^2 + 1/2 K' max(0, -e - s l0 - a)^2,   e = l - l0
//
// k is the stiffness below the limit s, 1 / K the compliance beyond it; K' = K if compression is resisted too, else 0. A
// constraint of the papers is k = 0, s = 0: eq. (5) of the cloth paper, softened by its compliance, and unilateral. a is 0
// for a penalty. For a limit that remembers its force, a is that force over K: an augmented Lagrangian.

struct LimitCurve
{
    int kind;         // 0: general; 1: only k is not zero, a plain spring; 2: only K, an inextensible thread
    real below;       // k, N/m
    real limit;       // s
    real beyond;      // K, N/m
    real compressed;  // K', N/m
    real damping;     // c / dt, N/m: resists the change of length during the step
    real slip;        // m: the limit acts as if the spring were this much longer, see renewed_limit
    real reach;       // the strain from which K is in the Hessian; -1: always
    real kept;        // the part of K that stays in the Hessian where the limit is slack
};

// A limit counts as taut if it is slack by less than this part of its length: rounding does not make a spring at rest length
// slack.
LAW real kept_of_limit(LimitCurve curve, real beyond_limit, real rest_length)
{
    return choose(beyond_limit + rest_length * real(7.62939453125e-6f) > 0.0f, real(1.0f), curve.kept);
}

// A spring at its present length: the force on node i is `force` n, n = (x_j - x_i) / l.
struct SpringState
{
    real force;   // N, positive pulls
    real along;   // N/m, the Hessian along n
    real across;  // N/m, the Hessian across n
    real energy;  // J
    real multiplier;  // N, the limit's part of the force
};

// The Hessian is modified for Newton's method: a slack thread keeps a part of its stiffness K along n, so that it becomes
// taut before it is overstretched, and the stiffness across n, f / l, is never negative. For a spring with a stiffness below
// its limit, K acts from its limit on only: k must be able to shorten the spring.
LAW SpringState limited_spring(LimitCurve curve, real length2, real inverse_length, real rest_length)
{
    real extension = length2 * inverse_length - rest_length;
    real slack = curve.limit * rest_length;
    real over = largest(extension + curve.slip - slack, real(0.0f));
    real under = largest(real(0.0f) - extension - curve.slip - slack, real(0.0f));
    SpringState state;
    state.multiplier = curve.beyond * over - curve.compressed * under;
    state.force = curve.below * extension + state.multiplier;
    real taut = extension + curve.slip;
    mask near = largest(taut, choose(curve.compressed > 0.0f, real(0.0f) - taut, taut)) > curve.reach * rest_length;
    real farther = largest(taut, choose(curve.compressed > 0.0f, real(0.0f) - taut, taut)) - slack;
    real kept = kept_of_limit(curve, farther, rest_length);
    state.along = curve.below + choose(near, largest(curve.beyond, curve.compressed) * kept, real(0.0f));
    state.across = largest(state.force * inverse_length, real(0.0f));
    state.energy = 0.5f * (curve.below * extension * extension + curve.beyond * over * over +
                           curve.compressed * under * under);
    return state;
}

// The same for the kinds 1 and 2.
LAW SpringState plain_spring(LimitCurve curve, real length2, real inverse_length, real rest_length)
{
    real extension = length2 * inverse_length - rest_length;
    SpringState state;
    state.multiplier = real(0.0f);
    state.force = curve.below * extension;
    state.along = curve.below;
    state.across = largest(state.force * inverse_length, real(0.0f));
    state.energy = 0.5f * state.force * extension;
    return state;
}

LAW SpringState taut_spring(LimitCurve curve, real length2, real inverse_length, real rest_length)
{
    real taut = length2 * inverse_length - rest_length + curve.slip;
    real over = largest(taut, real(0.0f));
    SpringState state;
    state.multiplier = curve.beyond * over;
    state.force = state.multiplier;
    state.along = curve.beyond * kept_of_limit(curve, taut, rest_length);
    state.across = state.force * inverse_length;
    state.energy = 0.5f * state.force * over;
    return state;
}

// Chosen by the kind of the curve, which is the same for all springs of a class: kinds 1 and 2 need only part of the law.
LAW SpringState spring_state(LimitCurve curve, real length2, real inverse_length, real rest_length)
{
    if (curve.kind == 2) return taut_spring(curve, length2, inverse_length, rest_length);
    if (curve.kind == 1) return plain_spring(curve, length2, inverse_length, rest_length);
    return limited_spring(curve, length2, inverse_length, rest_length);
}

// What a limit keeps from one step to the next.
struct LimitMemory
{
    real slip;       // m
    real stiffness;  // N/m, K above
};

// 1 / a, for a > 0
LAW real one_over(real a)
{
    real root = inverse_sqrt(a);
    return root * root;
}

// The method of multipliers, with one update per step: a limit begins with the force at which it ended, and K only corrects
// it. With a' = f / K0 and K = K0 / (1 + K0 c) a limit at rest has its true compliance c for any K0. K0 is as soft as the
// cloth allows (ClothModel::softest_limit). For the few springs beyond their limit by more than a thousandth it grows, at
// most by 4 per step.
//   strain: (l - l0) / l0 beyond the limit. Source: Hestenes, "Multiplier and gradient methods", 1969.
LAW LimitMemory renewed_limit(real multiplier, real strain, real stiffness, real compliance, real softest, real stiffest)
{
    real bare = stiffness * one_over(largest(1.0f - stiffness * compliance, real(0.0009765625f)));
    real grown = strain * real(1e3f);
    real next = choose(grown > 1.0f, bare * choose(grown > 4.0f, real(4.0f), grown), bare + (softest - bare) * real(0.125f));
    next = choose(next > stiffest, stiffest, largest(next, softest));
    LimitMemory memory;
    memory.slip = multiplier * one_over(next);
    memory.stiffness = next * one_over(1.0f + next * compliance);
    return memory;
}
