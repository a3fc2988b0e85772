//! The machine that draws and computes: a driver's adapter, or without any the evaluator, which is said.

use bossage_runner::{AdapterInfo, AdapterSelector, Machine};

use crate::console::Console;
use crate::error::Result;

/// Opens the adapter whose name contains `wanted`, or else the first. Where no driver is there, `embedded` takes over.
pub(crate) fn open(wanted: Option<&str>, console: Console) -> Result<Box<dyn Machine>> {
    let selector = wanted.map_or(AdapterSelector::Any, AdapterSelector::named);
    let machine = bossage_embedded::open(&selector)?;
    if wanted.is_none() && is_embedded(machine.info()) {
        console.note(format_args!(
            "no Vulkan adapter: running on `{}`, our own evaluator of shaders, whose times say nothing about a GPU; {}",
            bossage_embedded::NAME,
            bossage_runner::HOW_TO_GET_AN_ADAPTER
        ));
    }
    Ok(machine)
}

/// Whether this is the adapter that needs no driver.
pub(crate) fn is_embedded(info: &AdapterInfo) -> bool {
    info.name == bossage_embedded::NAME
}
