#pragma once

#include "protocol/gl/kernel_language.h"

// The GGX microfacet lobe and the share of light that it reflects in all, its directional albedo.

KERNEL_BEGIN

const float kPi = 3.14159265F;

/// Perceptual roughness below which highlights of point lights would be lost between samples and to rounding.
const float kMinRoughness = 0.045F;

/// GGX normal distribution (Walter et al. 2007, eq. 33), 1/sr. `n_cross_h_sq` is |n x h|^2 for the same h, which
/// stays exact at the peak where 1 - (n.h)^2 does not.
KERNEL float ggx_distribution(float n_dot_h, float n_cross_h_sq, float alpha) {
    float a = n_dot_h * alpha;
    float k = alpha / max(n_cross_h_sq + a * a, 1.0e-9F);
    return k * k * (1.0F / kPi);
}

/// Height-correlated Smith masking and shadowing over 4 (n.l) (n.v) (Heitz 2014, eq. 99; glTF 2.0 B.3.3).
KERNEL float smith_visibility(float n_dot_l, float n_dot_v, float alpha) {
    float a2 = alpha * alpha;
    float masking = n_dot_l * sqrt(n_dot_v * n_dot_v * (1.0F - a2) + a2);
    float shadowing = n_dot_v * sqrt(n_dot_l * n_dot_l * (1.0F - a2) + a2);
    return 0.5F / (masking + shadowing);
}

// Directional albedo. A lobe whose Fresnel term is f0 + (f90 - f0) (1 - v.h)^5 reflects
//     f0 + (f90 - f0) grazing(mu) - f0 loss(mu)
// of uniform light, where mu = n.v, 1 - loss is the albedo with a Fresnel term of one, and grazing that with a
// Fresnel term of (1 - v.h)^5: the split sum of Karis 2013, with A = 1 - loss - grazing and B = grazing.
//
// Both were integrated over the visible normals (Heitz 2018; Gauss-Legendre, 160 x 160 nodes, error below 2e-5) at 42
// roughnesses r in .045..1, evenly spaced above .2 and twice as dense below, and at 52 cosines in .002..1, half of
// them evenly spaced above .2 and the others geometrically below. With t = mu / (mu + alpha), which keeps the dip of
// width alpha at grazing angles in place, they are
//     loss = t (1 - t)^2 P(t, alpha),   grazing = (1 - mu)^5 Q(t, r)
// with P and Q of degree 4 in t and 3 in the other. The coefficients minimise the largest error (weighted least
// squares, reweighted by the errors 200 times, after Lawson 1961; points at mu < .02 weigh a fifth). Largest error
// for mu >= .02: loss .0035, grazing .0036; for mu in .002..0.02: .010 and .017.

/// Directional albedos of one roughness, as polynomials of t.
struct AlbedoCurves {
    float alpha;
    float p0;
    float p1;
    float p2;
    float p3;
    float p4;
    float q0;
    float q1;
    float q2;
    float q3;
    float q4;
};

/// What the two curves give at one cosine.
struct Albedos {
    float loss;     ///< share of light that the lobe loses where its Fresnel term is one, 0..1
    float grazing;  ///< albedo of the lobe whose Fresnel term is (1 - v.h)^5, 0..1
};

/// `roughness` is perceptual, kMinRoughness..1.
KERNEL AlbedoCurves make_albedo_curves(float roughness) {
    float r = roughness;
    float a = r * r;
    AlbedoCurves c;
    c.alpha = a;
    c.p0 = -0.1344F + a * (0.87002F + a * (4.16466F - a * 0.53688F));
    c.p1 = 3.44107F + a * (2.99408F + a * (-26.1492F - a * 1.62675F));
    c.p2 = -7.24667F + a * (-51.9951F + a * (177.003F - a * 1.07175F));
    c.p3 = 12.9504F + a * (119.883F + a * (-314.521F - a * 67.2273F));
    c.p4 = -8.3536F + a * (-75.7919F + a * (205.025F + a * 100.267F));
    c.q0 = 1.03491F + r * (-2.67235F + r * (2.40525F - r * 0.719723F));
    c.q1 = 1.28775F + r * (-7.78371F + r * (12.4007F - r * 5.95952F));
    c.q2 = -6.84761F + r * (41.3497F + r * (-55.3395F + r * 21.3178F));
    c.q3 = 9.77919F + r * (-45.8733F + r * (16.6449F + r * 11.8079F));
    c.q4 = -4.26325F + r * (15.3522F + r * (19.1678F + r * 1.53122F));
    return c;
}

/// Albedos at a cosine in 0..1.
KERNEL Albedos albedos_at(AlbedoCurves c, float cosine) {
    float t = cosine / (cosine + c.alpha);
    float s = 1.0F - t;
    float m = 1.0F - cosine;
    float m2 = m * m;
    Albedos result;
    result.loss = max(t * s * s * (c.p0 + t * (c.p1 + t * (c.p2 + t * (c.p3 + t * c.p4)))), 0.0F);
    result.grazing = m2 * m2 * m * (c.q0 + t * (c.q1 + t * (c.q2 + t * (c.q3 + t * c.q4))));
    return result;
}

/// Means of `albedos_at` over the hemisphere, weighted by the cosine: 2 times the integral of f(mu) mu. Fits to the
/// integrals of those curves, so that what is divided by them is normalised: together with the curves' largest value
/// they are within .0016 (loss) and .0004 (grazing).
KERNEL Albedos mean_albedos(float roughness) {
    float r = roughness;
    Albedos result;
    result.loss = r * r * (-0.005626878F + r * (0.3753502F + r * (2.80425F + r * (-4.022525F + r * 1.437523F))));
    result.grazing = 0.04681532F + r * (0.04627561F + r * (-0.46288608F + r * (0.64147743F - r * 0.26848615F)));
    return result;
}

KERNEL_END
