//! What drivers and compilers are known to get wrong, each with a witness. An entry whose witness no longer shows fails its case.

use bossage_runner::{AdapterInfo, AdapterSelector};

use crate::route::Route;

/// A function that leaves the acceptance interval on one driver or one route.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// The only route on which it shows; every route when `None`.
    pub route: Option<Route>,
    /// Part of the adapter's name or driver, as on the command line. Empty: every driver.
    pub driver: &'static str,
    /// The function's name.
    pub function: &'static str,
    /// Arguments at which it shows.
    pub witness: [f32; 2],
    /// What is wrong.
    pub reason: &'static str,
}

/// All that are known.
pub const ALL: &[Deviation] = &[
    Deviation {
        route: None,
        driver: "SwiftShader",
        function: "atan2",
        witness: [-0.0, 6.601_958_3],
        reason: "atan2(-0, x) is π for x > 0",
    },
    Deviation {
        route: Some(Route::Hlsl),
        driver: "",
        function: "sign",
        witness: [2.0, 0.0],
        reason: "naga writes `sign(x)` for HLSL as for WGSL, where its result is an integer: stored by `asuint`, its bits are no float's",
    },
    Deviation {
        route: Some(Route::Glsl),
        driver: "llvmpipe",
        function: "to_int",
        witness: [3e9, 0.0],
        reason: "naga writes `int(x)` for GLSL, which leaves numbers beyond the integers open where WGSL takes the nearest",
    },
    Deviation {
        route: Some(Route::Glsl),
        driver: "llvmpipe",
        function: "to_uint",
        witness: [-2.0, 0.0],
        reason: "naga writes `uint(x)` for GLSL, which leaves numbers beyond the integers open where WGSL takes the nearest",
    },
];

/// What is known of a function on a route and an adapter.
#[must_use]
pub fn of(function: &str, route: Route, info: &AdapterInfo) -> Option<&'static Deviation> {
    ALL.iter().find(|known| {
        known.function == function
            && known.route.is_none_or(|only| only == route)
            && (known.driver.is_empty() || AdapterSelector::named(known.driver).matches(info))
    })
}
