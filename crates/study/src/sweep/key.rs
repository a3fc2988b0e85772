//! What a point depends on, as a hash.

use bossage_runner::AdapterInfo;
use sha2::{Digest, Sha256};

use super::subject::Subject;
use super::{Cell, Options};

/// Changes when what is measured does, so that points of older versions are measured again.
const VERSION: u32 = 1;

/// The key of a point: the code that runs, its settings, the map, the rays, the machine and the way of measuring.
pub(super) fn of(machine: &AdapterInfo, cell: &Cell, subject: &Subject, options: &Options) -> String {
    let mut hash = Sha256::new();
    let mut add = |name: &str, bytes: &[u8]| {
        // Lengths, so that no two lists of parts run together.
        for part in [name.as_bytes(), bytes] {
            hash.update((part.len() as u64).to_le_bytes());
            hash.update(part);
        }
    };
    let map = &cell.map;
    let heights: Vec<u8> = map
        .field
        .texels
        .iter()
        .flat_map(|height| height.to_le_bytes())
        .collect();
    add("version", &VERSION.to_le_bytes());
    add("machine", format!("{machine:?}").as_bytes());
    add("options", format!("{options:?}").as_bytes());
    add("technique", subject.id.as_bytes());
    add("settings", subject.settings.to_string().as_bytes());
    add("route", subject.route.name().as_bytes());
    add("code", subject.prepared.text().as_bytes());
    add("name", map.name.as_bytes());
    add(
        "map",
        format!(
            "{}x{} {:?} {:?}",
            map.field.width, map.field.height, map.edge, map.layer
        )
        .as_bytes(),
    );
    add("heights", &heights);
    add("view", &cell.view_deg.to_le_bytes());
    add("rays", &super::kernel::pack(&cell.rays));
    let digest = hash.finalize();
    digest[..16].iter().map(|byte| format!("{byte:02x}")).collect()
}
