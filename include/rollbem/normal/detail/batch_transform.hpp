// Discrete Fourier transforms of many sequences of one length at a time.
#pragma once

#include "../../detail/language.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace rollbem::detail {

/// Complex numbers by their real and imaginary parts. Element j of sequence k is at j * count + k, so that the
/// innermost loops of a transform run over neighbouring numbers.
struct ComplexBatch {
    std::vector<double> re, im;

    void resize(std::size_t size) {
        re.resize(size);
        im.resize(size);
    }
};

/// Stockham's transform with factors of 4, 2, 3 and 5.
class BatchTransform {
public:
    /// The smallest length from `least` on without a prime factor above 5.
    static std::ptrdiff_t good_length(std::ptrdiff_t least) {
        for (std::ptrdiff_t n = least;; ++n) {
            std::ptrdiff_t rest = n;
            for (const std::ptrdiff_t p : {2, 3, 5}) {
                while (rest % p == 0) rest /= p;
            }
            if (rest == 1) return n;
        }
    }

    /// Prepares for another length, a good one.
    void prepare(std::ptrdiff_t length) {
        if (length == length_) return;
        length_ = length;
        factors_.clear();
        std::ptrdiff_t rest = length;
        for (const std::ptrdiff_t p : {4, 2, 3, 5}) {
            for (; rest % p == 0; rest /= p) factors_.push_back(p);
        }
        cosine_.resize(std::size_t(length));
        sine_.resize(std::size_t(length));
        for (std::size_t k = 0; k < std::size_t(length); ++k) {
            const double angle = -2 * std::numbers::pi * double(k) / double(length);
            cosine_[k] = std::cos(angle);
            sine_[k] = std::sin(angle);
        }
    }

    /// Sum over j of x_j exp(-2 pi i j k / length) of `count` sequences. The inverse, times the length, is that of the
    /// batch with real and imaginary parts exchanged.
    void apply(ComplexBatch& x, std::ptrdiff_t count) {
        if (other_.re.size() < x.re.size()) other_.resize(x.re.size());
        std::ptrdiff_t left = length_, stride = 1;
        for (const std::ptrdiff_t factor : factors_) {
            const std::ptrdiff_t groups = left / factor, size = stride * count;
            for (std::ptrdiff_t p = 0; p < groups; ++p) {
                const Pass pass{x.re.data() + p * size,
                                x.im.data() + p * size,
                                other_.re.data() + factor * p * size,
                                other_.im.data() + factor * p * size,
                                groups * size,
                                size,
                                p * stride};
                switch (factor) {
                    case 2: over<2>(pass); break;
                    case 3: over<3>(pass); break;
                    case 4: over<4>(pass); break;
                    default: over<5>(pass);
                }
            }
            std::swap(x.re, other_.re);
            std::swap(x.im, other_.im);
            left = groups;
            stride *= factor;
        }
    }

private:
    // One group of a pass: from numbers `apart` from one another to neighbouring blocks of `size` numbers, the l-th of
    // which is turned by l * `turn` of the length.
    struct Pass {
        const double *re, *im;
        double *to_re, *to_im;
        std::ptrdiff_t apart, size, turn;
    };
    // One complex number, or four neighbouring ones, of which a processor computes several at a time.
    using Four = Eigen::Array<double, 4, 1>;
    template <class Real>
    struct Number {
        Real re, im;

        friend Number operator+(const Number& a, const Number& b) { return {a.re + b.re, a.im + b.im}; }
        friend Number operator-(const Number& a, const Number& b) { return {a.re - b.re, a.im - b.im}; }
        friend Number operator*(double a, const Number& b) { return {a * b.re, a * b.im}; }
        Number times_i() const { return {-im, re}; }
    };

    template <class Real>
    static Number<Real> read(const Pass& of, std::ptrdiff_t k, std::ptrdiff_t i) {
        const double *re = of.re + k * of.apart + i, *im = of.im + k * of.apart + i;
        if constexpr (std::is_same_v<Real, double>) {
            return {*re, *im};
        } else {
            return {Eigen::Map<const Real>(re), Eigen::Map<const Real>(im)};
        }
    }
    template <class Real>
    static void write(const Pass& of, std::ptrdiff_t k, std::ptrdiff_t i, const Number<Real>& value) {
        double *re = of.to_re + k * of.size + i, *im = of.to_im + k * of.size + i;
        if constexpr (std::is_same_v<Real, double>) {
            *re = value.re;
            *im = value.im;
        } else {
            Eigen::Map<Real>{re} = value.re;
            Eigen::Map<Real>{im} = value.im;
        }
    }

    // Cosines and sines of the angles by which the blocks of a pass are turned.
    template <std::size_t factor>
    struct Turns {
        std::array<double, factor> c, s;
    };

    template <std::size_t factor>
    void over(const Pass& of) const {
        Turns<factor> turns;
        for (std::size_t k = 0; k < factor; ++k) {
            turns.c[k] = cosine_[k * std::size_t(of.turn)];
            turns.s[k] = sine_[k * std::size_t(of.turn)];
        }
        of.turn == 0 ? over<factor, false>(of, turns) : over<factor, true>(of, turns);
    }
    template <std::size_t factor, bool turned>
    static void over(const Pass& of, const Turns<factor>& turns) {
        std::ptrdiff_t i = 0;
        for (; i + 4 <= of.size; i += 4) butterfly<factor, turned, Four>(of, i, turns);
        for (; i < of.size; ++i) butterfly<factor, turned, double>(of, i, turns);
    }

    template <std::size_t factor, bool turned, class Real>
    static void butterfly(const Pass& of, std::ptrdiff_t i, const Turns<factor>& turns) {
        const auto x = [&](std::ptrdiff_t k) { return read<Real>(of, k, i); };
        const auto put = [&](std::size_t k, const Number<Real>& value) {
            const double c = turns.c[k], s = turns.s[k];
            const bool turns_it = turned && k > 0;
            write<Real>(of, std::ptrdiff_t(k), i,
                        turns_it ? Number<Real>{c * value.re - s * value.im, c * value.im + s * value.re} : value);
        };
        const Number<Real> a = x(0), b = x(1);
        if constexpr (factor == 2) {
            put(0, a + b);
            put(1, a - b);
        } else if constexpr (factor == 3) {
            constexpr double half_root = std::numbers::sqrt3 / 2;
            const Number<Real> c = x(2), sum = b + c, middle = a - 0.5 * sum, across = half_root * (b - c).times_i();
            put(0, a + sum);
            put(1, middle - across);
            put(2, middle + across);
        } else if constexpr (factor == 4) {
            const Number<Real> c = x(2), d = x(3), even = a + c, odd = b + d, fall = a - c, across = (b - d).times_i();
            put(0, even + odd);
            put(1, fall - across);
            put(2, even - odd);
            put(3, fall + across);
        } else {
            // cosines and sines of 72 and 144 degrees
            constexpr double c_1 = 0.30901699437494742, c_2 = -0.80901699437494742, s_1 = 0.95105651629515357,
                             s_2 = 0.58778525229247313;
            const Number<Real> c = x(2), d = x(3), e = x(4), outer = b + e, inner = c + d, by_outer = b - e,
                               by_inner = c - d, first = a + c_1 * outer + c_2 * inner,
                               second = a + c_2 * outer + c_1 * inner,
                               turn_1 = (s_1 * by_outer + s_2 * by_inner).times_i(),
                               turn_2 = (s_2 * by_outer - s_1 * by_inner).times_i();
            put(0, a + outer + inner);
            put(1, first - turn_1);
            put(2, second - turn_2);
            put(3, second + turn_2);
            put(4, first + turn_1);
        }
    }

    std::ptrdiff_t length_ = 0;
    std::vector<std::ptrdiff_t> factors_;
    std::vector<double> cosine_, sine_;
    ComplexBatch other_;
};

}  // namespace rollbem::detail
