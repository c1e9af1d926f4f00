// Springs with a limit, as the implicit step sees them: an energy, its force, and how stiff it is along and across.
//
//   E(l) = 1/2 k e^2 + 1/2 K max(0, e - s l0 + a)^2 + 1/2 K' max(0, -e - s l0 - a)^2,   e = l - l0
//
// k is the stiffness below the limit s, 1 / K the compliance beyond it, K' = K when compression is resisted too, else 0.
// A constraint of the papers is k = 0, s = 0: eq. (5) of the cloth paper made soft by its compliance, and unilateral.
// a is 0 for a penalty; of a limit that remembers its force it is that force over K: an augmented Lagrangian.

struct LimitCurve
{
    int kind;         // 0; 1: k alone is not zero, a plain spring; 2: K alone, a thread that does not give
    real below;       // k, N/m
    real limit;       // s
    real beyond;      // K, N/m
    real compressed;  // K', N/m
    real damping;     // c / dt, N/m: resists the change of length during the step
    real slip;        // m: the limit acts as if the spring were this much longer, see renewed_limit
    real reach;       // the stretch from which on K is in the Hessian; -1: always
    real kept;        // the part of K that stays in the Hessian where the limit is slack
};

// Slack by less than this part of its length a limit counts as taut: what rests at its length does so whatever rounding
// makes of it.
LAW real kept_of_limit(LimitCurve curve, real beyond_limit, real rest_length)
{
    return choose(beyond_limit + rest_length * real(7.62939453125e-6f) > 0.0f, real(1.0f), curve.kept);
}

// What a spring does at its length: on node i the force is `force` n, n = (x_j - x_i) / l.
struct SpringState
{
    real force;   // N, positive pulls
    real along;   // N/m, the Hessian along n
    real across;  // N/m, the Hessian across n
    real energy;  // J
    real multiplier;  // N, what the limit adds to the force of the stiffness below it
};

// The Hessian is the one that Newton's method wants, not the exact one: a slack thread keeps a part of its stiffness K along
// n, so that it is taut before it is overstretched, and the stiffness across n, f / l, is never negative. A spring that has
// a stiffness below its limit has K from its limit on alone: k has to be free to shorten it.
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

// By the kind of the curve, which is the same for all springs of a class: two of them need but a part of the law.
LAW SpringState spring_state(LimitCurve curve, real length2, real inverse_length, real rest_length)
{
    if (curve.kind == 2) return taut_spring(curve, length2, inverse_length, rest_length);
    if (curve.kind == 1) return plain_spring(curve, length2, inverse_length, rest_length);
    return limited_spring(curve, length2, inverse_length, rest_length);
}

// What a limit remembers of a step for the next one.
struct LimitMemory
{
    real slip;       // m
    real stiffness;  // N/m, K above
};

// 1 / a of a positive number.
LAW real one_over(real a)
{
    real root = inverse_sqrt(a);
    return root * root;
}

// The multiplier method, one update a step: the force that the limit ended with is what it begins with, and K only makes
// it right. With a' = f / K0 and K = K0 / (1 + K0 c) a limit at rest has its true compliance c, whatever K0 is. K0 is as soft
// as the cloth allows (ClothModel::softest_limit), but of the few springs that are beyond their limit by more than a
// thousandth it grows, by 4 at most in a step.
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
