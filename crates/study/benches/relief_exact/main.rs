//! The fastest exact meeting of view ray and bilinear surface: designs beside each other, each checked against f64 before it is timed.
//!
//! `cargo bench --profile dev -p bossage-study --bench relief_exact -- [--runs N] [--designs A,B] [--angles D,D] [--scatter] [--cpu] [MAP …]`. A MAP is an image
//! of heights that tiles; it is measured beside the bundled ones. `--scatter` draws places and azimuths by lot, a hard case for wide SIMD;
//! without it 256² rays lie in a grid over the tile and look one way, as the pixels of a picture do.
//!
//! The price is a ratio to `parallax_occlusion` with 64 layers in the same run. Goals: at most 0.5 up to 60° from the normal, 1.0 at
//! 75°, 1.5 at 85°; every ray right within 0.01 texel by `relief_grazing`, grazing rays counted. They are printed as met or missed. Of wall clock on
//! a busy machine only the median of many runs says something; `--cpu` takes the CPU time of this process instead (Linux, drivers on the CPU).

#![allow(clippy::print_stdout, reason = "a benchmark prints")]

mod bakes;
mod check;
mod cpu_clock;
mod designs;
mod maps;
mod rays;
mod table;

use std::collections::BTreeMap;

use bossage_runner::{
    AdapterSelector, AddressMode, BufferData, ComputeJob, Device, Resources, SamplerSettings, TextureData,
    TimedJob, Timing, TimingOptions, time,
};

use designs::{Built, DESIGNS, Design};
use maps::Map;
use rays::View;

type Failure = Box<dyn std::error::Error>;

/// Thickness of the layer, in widths of the tile.
const DEPTH: f32 = 0.05;

/// Layers of the technique that is the measure.
const LAYERS: f32 = 64.0;

struct Wanted {
    runs: usize,
    designs: Vec<&'static Design>,
    angles: Vec<f64>,
    scatter: bool,
    cpu: bool,
    maps: Vec<Map>,
}

fn main() -> Result<(), Failure> {
    let wanted = wanted(std::env::args().skip(1))?;
    let device = Device::open(&AdapterSelector::Any)?;
    println!("{}, {} runs", device.info(), wanted.runs);
    for map in &wanted.maps {
        measure_map(&device, &wanted, map)?;
    }
    Ok(())
}

fn wanted(arguments: impl Iterator<Item = String>) -> Result<Wanted, Failure> {
    let mut wanted = Wanted {
        runs: 9,
        designs: DESIGNS.iter().collect(),
        angles: vec![0.0, 30.0, 60.0, 75.0, 85.0],
        scatter: false,
        cpu: false,
        maps: maps::bundled()?,
    };
    let mut arguments = arguments.filter(|argument| argument != "--bench");
    while let Some(argument) = arguments.next() {
        let mut value = || arguments.next().ok_or(format!("{argument} wants a value"));
        match argument.as_str() {
            "--runs" => wanted.runs = value()?.parse()?,
            "--angles" => wanted.angles = value()?.split(',').map(str::parse).collect::<Result<_, _>>()?,
            "--scatter" => wanted.scatter = true,
            "--cpu" => wanted.cpu = true,
            "--designs" => {
                let names = value()?;
                wanted.designs = std::iter::once("parallax_occlusion")
                    .chain(names.split(','))
                    .map(designs::find)
                    .collect::<Result<_, _>>()?;
            }
            path => wanted.maps.push(maps::read(path)?),
        }
    }
    Ok(wanted)
}

fn measure_map(device: &Device, wanted: &Wanted, map: &Map) -> Result<(), Failure> {
    let takes = |design: &&&Design| (design.takes)(map);
    let built = wanted
        .designs
        .iter()
        .filter(takes)
        .map(|design| Built::new(design, map));
    let built = built.collect::<Result<Vec<_>, _>>()?;
    for &angle in &wanted.angles {
        let views = rays::views(angle, wanted.scatter);
        measure_views(device, wanted, map, &built, angle, &views)?;
    }
    Ok(())
}

fn measure_views(
    device: &Device,
    wanted: &Wanted,
    map: &Map,
    built: &[Built],
    angle: f64,
    views: &[View],
) -> Result<(), Failure> {
    let bytes = rays::bytes(views);
    let heights = map.texture();
    let jobs: Vec<ComputeJob<'_>> = built
        .iter()
        .map(|design| job(design, map, &heights, &bytes, views.len()))
        .collect();
    let truth = check::Truth::new(map, views);
    let errors = jobs
        .iter()
        .map(|job| Ok(truth.compare(&job.run(device)?)))
        .collect::<Result<Vec<_>, Failure>>()?;
    let times = if wanted.cpu {
        cpu_clock::cpu_times(device, &jobs, wanted.runs)?
    } else {
        wall_times(device, &jobs, wanted.runs)?
    };
    for ((design, time), errors) in built.iter().zip(&times).zip(&errors) {
        table::print(map, angle, design.name, time, &times[0], errors);
    }
    Ok(())
}

fn wall_times(device: &Device, jobs: &[ComputeJob<'_>], runs: usize) -> Result<Vec<Timing>, Failure> {
    let timed: Vec<TimedJob<'_>> = jobs.iter().map(TimedJob::Compute).collect();
    let options = TimingOptions {
        runs,
        run_ms: 20.0,
        max_repetitions: 64,
    };
    Ok(time(device, &timed, &options)?)
}

fn job<'a>(
    design: &'a Built,
    map: &Map,
    heights: &'a TextureData,
    rays: &'a [u8],
    count: usize,
) -> ComputeJob<'a> {
    let search = [
        ("scale", DEPTH),
        ("bias", -DEPTH),
        ("v_factor", 1.0),
        ("level", 0.0),
        ("steps", LAYERS),
        ("refinements", 0.0),
        ("edge_mode", map.edge_number()),
    ];
    let named = search.map(|(name, value)| (format!("search.{name}"), vec![value]));
    let mut textures = BTreeMap::from([("height_map".to_owned(), heights)]);
    textures.extend(design.maps.iter().map(|(name, map)| ((*name).to_owned(), map)));
    let buffers = [
        ("rays".to_owned(), BufferData::Bytes(rays)),
        ("hits".to_owned(), BufferData::Output(16 * count)),
    ];
    let sampler = SamplerSettings {
        address: [AddressMode::Wrap, AddressMode::Mirror, AddressMode::Clamp][map.edge as usize],
        ..SamplerSettings::default()
    };
    ComputeJob {
        name: design.name,
        shader: design.shader(),
        resources: Resources {
            uniforms: named.into(),
            buffers: buffers.into(),
            textures,
            samplers: [("surface_sampler".to_owned(), sampler)].into(),
        },
        workgroups: [(count as u32).div_ceil(64), 1, 1],
    }
}
