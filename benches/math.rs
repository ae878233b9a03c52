//! Nanoseconds a call of the mathematics: one element at a time, and sixteen lanes. Each published form beside the others.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use vsgl_core::brdf::albedo::ggx_albedo;
use vsgl_core::brdf::ggx;
use vsgl_core::glam::Vec3;
use vsgl_core::math::elementary as el;
use vsgl_core::sg::filtering::FilteredView;
use vsgl_core::sg::glossy::GlossyView;
use vsgl_core::sg::{cosine, hemisphere, lobe, vmf, warp};

const LANES: usize = 16;
type Lanes = [f32; LANES];

/// A group of functions of sharpness and cosine, each over lanes and one by one.
macro_rules! group {
    ($group:ident: $($name:ident = |$x:ident, $y:ident| $body:expr;)*) => {
        fn $group(c: &mut Criterion) {
            let x: Lanes = std::array::from_fn(|i| 10f32.powf(i as f32 * 0.4 - 2.0));
            let y: Lanes = std::array::from_fn(|i| (i as f32 - 7.5) / 8.0);
            let mut group = c.benchmark_group(stringify!($group));
            // Times are for sixteen; criterion divides for the rate.
            group.throughput(Throughput::Elements(LANES as u64));
            $({
                #[multiversion::multiversion(targets("x86_64+avx2+fma"))]
                fn lanes(x: &Lanes, y: &Lanes) -> Lanes {
                    let (x, y) = (*x, *y);
                    let mut out = [0.0; LANES];
                    for i in 0..LANES {
                        let ($x, $y) = (x[i], y[i]);
                        out[i] = $body;
                    }
                    out
                }
                #[inline(never)]
                fn one($x: f32, $y: f32) -> f32 {
                    let _ = $y;
                    $body
                }
                group.bench_function(concat!(stringify!($name), "/lanes"), |b| {
                    b.iter(|| lanes(black_box(&x), black_box(&y)));
                });
                group.bench_function(concat!(stringify!($name), "/scalar"), |b| {
                    b.iter(|| {
                        for i in 0..LANES {
                            black_box(one(black_box(x[i]), black_box(y[i])));
                        }
                    });
                });
            })*
            group.finish();
        }
    };
}

group! { elementary:
    exp = |x, y| el::exp(x * y);
    expm1_over_x = |x, y| el::expm1_over_x(-x * y.abs());
    log = |x, y| el::log(x) * y;
    erf = |x, y| el::erf(x * y);
    erfc = |x, y| el::erfc(x * y);
    erf_integral = |x, y| el::erf_integral(x * y.abs());
}

group! { lobes:
    integral = |x, y| lobe::integral(x) * y;
    product = |x, y| lobe::product(Vec3::new(0.6, 0.0, 0.8), x, Vec3::new(0.0, 0.6, y), 20.0).log_amplitude;
    mean_length = |x, y| vmf::mean_length(x) * y;
    convolve = |x, y| vmf::convolve(x, 30.0 + y);
    sharpness_exact = |x, y| vmf::sharpness_exact(vmf::mean(x)) * y;
}

group! { hemispherical:
    integral_2018 = |x, y| hemisphere::integral_2018(x, y);
    integral_2022 = |x, y| hemisphere::integral_2022(x, y);
    integral = |x, y| hemisphere::integral(x, y);
    share_2022 = |x, y| hemisphere::share_2022(x, y);
}

group! { clamped_cosine:
    constant = |x, y| cosine::constant(x, y);
    sg_2015 = |x, y| cosine::sg_2015(x, y);
    sg_iwasaki_2012 = |x, y| cosine::sg_iwasaki_2012(x, y);
    sg_product = |x, y| cosine::sg_product(x, y);
    lobes_2018 = |x, y| cosine::lobes_2018(x, y);
    lobes_2022 = |x, y| cosine::lobes_2022(x, y);
    interpolated_2024 = |x, y| cosine::interpolated_2024(x, y);
    interpolated_v13 = |x, y| cosine::interpolated_v13(x, y);
    interpolated_v14 = |x, y| cosine::interpolated_v14(x, y);
    mean_clamped_cosine = |x, y| cosine::mean_clamped_cosine(x, y);
}

#[inline(always)]
fn view(y: f32) -> Vec3 {
    Vec3::new((1.0 - y * y).max(0.0).sqrt(), 0.0, y.abs())
}

const LIGHT: Vec3 = Vec3::new(-0.6, 0.0, 0.8);

group! { glossy:
    reflectance = |x, y| ggx::reflectance(view(y), LIGHT, Vec3::Z, 0.3) * x;
    albedo = |x, y| ggx_albedo(y, 0.1) .b * x;
    sg_2015 = |x, y| warp::glossy_sg_2015(view(y), Vec3::Z, 0.3, LIGHT, x);
    asg_2016 = |x, y| warp::glossy_asg_2016(view(y), Vec3::Z, 0.3, LIGHT, x);
    asg_2015 = |x, y| warp::glossy_asg_2015(view(y), Vec3::Z, 0.3, LIGHT, x);
    filtered_2024 = |x, y| GlossyView::new(view(y), Vec3::Z, 0.3).filtered_2024(LIGHT, x);
    masked = |x, y| GlossyView::new(view(y), Vec3::Z, 0.3).masked(LIGHT, x, x);
    blended = |x, y| GlossyView::new(view(y), Vec3::Z, 0.3).blended(LIGHT, x, x);
    masked_anisotropic = |x, y| FilteredView::reflection(view(y), 0.3, 0.1).masked(LIGHT, x, x);
    diffuse_and_glossy = |x, y| {
        let mean = cosine::mean_clamped_cosine(x * 0.9, y);
        mean + GlossyView::new(view(y), Vec3::Z, 0.3).masked(LIGHT, x, x * 0.9)
    };
}

criterion_group!(
    benches,
    elementary,
    lobes,
    hemispherical,
    clamped_cosine,
    glossy
);
criterion_main!(benches);
