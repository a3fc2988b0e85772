//! Pictures: the draws of all passes, in their order.

use bossage_runner::{Error, RenderJob, RenderOutput, within};

use crate::draw;
use crate::frame::Frame;
use crate::stages::Open;

/// The longest side of a picture: what WebGPU promises everywhere.
const MAX_SIDE: u32 = 8192;

/// The most targets of a picture: what WebGPU promises everywhere.
const MAX_TARGETS: usize = 8;

/// Draws a picture, with whatever runs the two stages of each draw. All else is the same for every machine without a driver.
///
/// # Errors
/// What a device refuses is refused here, too; and what the stages say.
pub fn render(job: &RenderJob<'_>, open: &Open<'_>) -> Result<RenderOutput, Error> {
    check(job)?;
    let mut frame = Frame::new(job);
    for draw in job.passes.iter().flatten() {
        draw::run(open, job, draw, &mut frame)?;
    }
    Ok(frame.finish(job.read_depth))
}

fn check(job: &RenderJob<'_>) -> Result<(), Error> {
    for (location, target) in job.targets.iter().enumerate() {
        target.validate(job.name, location)?;
    }
    if job.width.min(job.height) == 0 {
        return Err(Error::Texture {
            name: job.name.to_owned(),
            problem: format!("a picture of {} x {} pixels", job.width, job.height),
        });
    }
    let longer = u64::from(job.width.max(job.height));
    within(job.name, "the picture's side", longer, u64::from(MAX_SIDE))?;
    let targets = job.targets.len() as u64;
    within(job.name, "the number of targets", targets, MAX_TARGETS as u64)
}
