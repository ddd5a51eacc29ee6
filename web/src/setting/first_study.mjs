// What the page shows who comes without an address: six in ten balance, both fates are seen within a minute.
export const FIRST_STUDY = "table-2-omega-2.4";
