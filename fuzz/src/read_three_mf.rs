use crate::model::holds;

/// Where the model is in a package that does not say.
const NAME: &[u8] = b"3D/3dmodel.model";

/// Reads the bytes as a 3MF file, and as the model in one: mutations seldom keep the checksum of an archive.
pub fn read_three_mf(bytes: &[u8]) {
    holds(argil_mesh::three_mf(bytes));
    holds(argil_mesh::three_mf(&archive(bytes)));
}

/// A ZIP archive of one part that is not packed.
fn archive(part: &[u8]) -> Vec<u8> {
    let checksum = !part.iter().fold(!0_u32, |sum, byte| {
        (0..8).fold(
            sum ^ u32::from(*byte),
            |sum, _| if sum & 1 == 1 { sum >> 1 ^ 0xedb8_8320 } else { sum >> 1 },
        )
    });
    let size = part.len() as u32;
    // Version and method, no time, checksum and sizes, length of the name.
    let mut common = vec![20, 0, 0, 0, 0, 0, 0, 0, 0, 0];
    common.extend([checksum, size, size].iter().flat_map(|number| number.to_le_bytes()));
    common.extend([NAME.len() as u8, 0, 0, 0]);
    let mut bytes = [b"PK\x03\x04", &common[..], NAME, part].concat();
    let directory = bytes.len() as u32;
    bytes.extend([b"PK\x01\x02\x14\x00", &common[..], &[0; 14], NAME].concat());
    let length = bytes.len() as u32 - directory;
    bytes.extend(b"PK\x05\x06\0\0\0\0\x01\0\x01\0");
    bytes.extend([length, directory].iter().flat_map(|number| number.to_le_bytes()));
    bytes.extend([0, 0]);
    bytes
}
