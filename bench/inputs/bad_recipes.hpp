// SPDX-License-Identifier: MIT
#pragma once

namespace boxstream::bench {

/// Batches that searches found, each the worst of its search at the time. `worst --known` measures them all.
inline constexpr const char* bad_recipes[] = {
    // Most time per box and pair: large flat boxes of many sizes around small ones.
    "n=20000,seed=137,order=shuffled,axis=2;weight=6,place=uniform,groups=16,extent=-1.16:0:-0.28,size=-2.27:-4.68:-1."
    "53,"
    "decades=3,alike=1,copies=1,snap=0;weight=5,place=clusters,groups=1,extent=0.44:-2.05:1.12,size=-2.73:-1.65:-4,"
    "decades=0,alike=1,copies=1,snap=0",
    "n=20000,seed=691,order=shuffled,axis=2;weight=1,place=uniform,groups=4,extent=-2.37:-0.48:0,size=-1.58:-1.02:-2."
    "73,"
    "decades=0,alike=1,copies=1,snap=0;weight=4,place=shell,groups=19,extent=-0.11:-0.35:0,size=-0.63:-1.39:-3.57,"
    "decades=0,alike=1,copies=1,snap=0;weight=4,place=uniform,groups=1,extent=0:-1.56:-3.46,size=-4:-3.44:-3.44,"
    "decades=0,alike=1,copies=1,snap=0",
    // Most comparisons: bars of several lengths, four to a line, in heaps within heaps.
    "n=30000,seed=985,order=descending,axis=2;weight=1,place=shell,groups=25,extent=0.21:0:0,size=-5.13:-5.37:-0.97,"
    "decades=1.98,alike=0,copies=1,snap=0,pieces=4,jitter=1e-07,levels=3,shrink=3.71",
    // Smallest ratio to the plain sweep: input in an order that its sort makes use of.
    "n=20000,seed=632,order=descending,axis=1;weight=3,place=uniform,groups=198,extent=0:0:0,size=-5.31:-4.11:-4.11,"
    "decades=0,alike=1,copies=1,snap=0.015625;weight=9,place=crossing,groups=17,extent=0:0:-1.87,size=-0.09:-4.85:-4."
    "62,"
    "decades=2.96,alike=1,copies=1,snap=0;weight=2,place=uniform,groups=157,extent=0:-2.4:-1.13,size=-5.03:-4.55:-4.55,"
    "decades=0,alike=0,copies=1,snap=0",
    "n=20000,seed=785,order=descending,axis=1;weight=5,place=diagonal,groups=10,extent=-0.36:2.1:-0.19,"
    "size=-2.33:-3.71:-2.61,decades=0.81,alike=0,copies=1,snap=0",
    // Smallest ratio to CGAL: sorted, hardly a pair.
    "n=5000,seed=114,order=ascending,axis=2;weight=48,place=diagonal,groups=2,extent=0.59:0:0,size=-4.3:-2.22:-4.51,"
    "decades=0,alike=0,copies=1,snap=0;weight=2,place=diagonal,groups=51,extent=-2.76:0:0.58,size=-5.44:-4.18:-2.68,"
    "decades=0.97,alike=0,copies=1,snap=0;weight=9,place=uniform,groups=1,extent=-2.76:0:0,size=-5.78:-2.09:-2.73,"
    "decades=2.08,alike=0,copies=1,snap=0",
    // Small batches: most time per box and pair, then smallest ratios to brute force and the sweep.
    "n=1000,seed=675,order=ascending,axis=0;weight=6,place=shell,groups=9,extent=0:-1.28:0.61,size=-1.78:-0.14:-3.64,"
    "decades=2.84,alike=0,copies=1,snap=0;weight=10,place=lattice,groups=51,extent=0:-0.14:-3.67,size=-2.67:-4.91:-3."
    "13,"
    "decades=2.43,alike=1,copies=1,snap=0;weight=8,place=shell,groups=203,extent=-1.4:-2.95:-2.16,size=-0.82:-5.16:-4."
    "51,"
    "decades=0.01,alike=0,copies=1,snap=0",
    "n=300,seed=55,order=shuffled,axis=0;weight=2,place=uniform,groups=4,extent=-0.05:-0.23:-2.31,size=-3.19:-3.25:0."
    "02,"
    "decades=3.35,alike=1,copies=1,snap=0;weight=12,place=diagonal,groups=294,extent=-2.44:-1.69:0,size=-2.44:-0.89:-4."
    "42,"
    "decades=1.58,alike=0,copies=1,snap=0;weight=16,place=shell,groups=12,extent=0.17:-2.27:-0.65,size=-0.05:-4.67:-3."
    "79,"
    "decades=0.04,alike=0,copies=1,snap=0;weight=10,place=shell,groups=2,extent=0.52:0:-0.4,size=-5.14:-4.37:0.75,"
    "decades=2.7,alike=0,copies=1,snap=0",
    "n=64,seed=826,order=ascending,axis=2;weight=1,place=diagonal,groups=1,extent=-1.32:0:-1.73,size=-0.89:-4.34:-2.96,"
    "decades=0,alike=1,copies=1,snap=0.0001220703125",
    "n=64,seed=621,order=descending,axis=2;weight=47,place=shell,groups=150,extent=-1:-1.67:0,size=-2.66:-2.66:-2.66,"
    "decades=0,alike=0,copies=1,snap=0;weight=2,place=uniform,groups=252,extent=0:0:0,size=0.26:-2.91:-5.22,decades=3."
    "43,"
    "alike=1,copies=1,snap=0",
};

}  // namespace boxstream::bench
