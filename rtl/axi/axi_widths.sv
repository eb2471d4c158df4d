// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// Stops the elaboration of biss_axi if the stream has another width than its other parameters ask
// for. The text names the right number. Yosys prints the text of $error as it is written, so each
// number is written out.
//
// Clock domain: none. Misuse: an error at elaboration.

module axi_widths #(
  parameter int unsigned DataW    = 32,  // bits of TDATA, as given
  parameter int unsigned UserW    = 1,   // bits of TUSER, as given
  parameter int unsigned NeedData = 32,  // 32 to 512 in steps of 32, or to 1024 in steps of 64
  parameter int unsigned NeedUser = 1    // 1 to 16
) ();

`ifndef __ICARUS__  // Icarus 11 knows no $error here
  if (DataW != NeedData) begin : gen_data
    case (NeedData)
      32:    begin : gen_32 $error("S_AXIS_TDATA_WIDTH must be 32 here"); end
      64:    begin : gen_64 $error("S_AXIS_TDATA_WIDTH must be 64 here"); end
      96:    begin : gen_96 $error("S_AXIS_TDATA_WIDTH must be 96 here"); end
      128:   begin : gen_128 $error("S_AXIS_TDATA_WIDTH must be 128 here"); end
      160:   begin : gen_160 $error("S_AXIS_TDATA_WIDTH must be 160 here"); end
      192:   begin : gen_192 $error("S_AXIS_TDATA_WIDTH must be 192 here"); end
      224:   begin : gen_224 $error("S_AXIS_TDATA_WIDTH must be 224 here"); end
      256:   begin : gen_256 $error("S_AXIS_TDATA_WIDTH must be 256 here"); end
      288:   begin : gen_288 $error("S_AXIS_TDATA_WIDTH must be 288 here"); end
      320:   begin : gen_320 $error("S_AXIS_TDATA_WIDTH must be 320 here"); end
      352:   begin : gen_352 $error("S_AXIS_TDATA_WIDTH must be 352 here"); end
      384:   begin : gen_384 $error("S_AXIS_TDATA_WIDTH must be 384 here"); end
      416:   begin : gen_416 $error("S_AXIS_TDATA_WIDTH must be 416 here"); end
      448:   begin : gen_448 $error("S_AXIS_TDATA_WIDTH must be 448 here"); end
      480:   begin : gen_480 $error("S_AXIS_TDATA_WIDTH must be 480 here"); end
      512:   begin : gen_512 $error("S_AXIS_TDATA_WIDTH must be 512 here"); end
      576:   begin : gen_576 $error("S_AXIS_TDATA_WIDTH must be 576 here"); end
      640:   begin : gen_640 $error("S_AXIS_TDATA_WIDTH must be 640 here"); end
      704:   begin : gen_704 $error("S_AXIS_TDATA_WIDTH must be 704 here"); end
      768:   begin : gen_768 $error("S_AXIS_TDATA_WIDTH must be 768 here"); end
      832:   begin : gen_832 $error("S_AXIS_TDATA_WIDTH must be 832 here"); end
      896:   begin : gen_896 $error("S_AXIS_TDATA_WIDTH must be 896 here"); end
      960:   begin : gen_960 $error("S_AXIS_TDATA_WIDTH must be 960 here"); end
      1024:  begin : gen_1024 $error("S_AXIS_TDATA_WIDTH must be 1024 here"); end
      default: begin : gen_other $error("S_AXIS_TDATA_WIDTH is wrong"); end
    endcase
  end
  if (UserW != NeedUser) begin : gen_user
    case (NeedUser)
      1:    begin : gen_1 $error("S_AXIS_TUSER_WIDTH must be 1 here"); end
      2:    begin : gen_2 $error("S_AXIS_TUSER_WIDTH must be 2 here"); end
      3:    begin : gen_3 $error("S_AXIS_TUSER_WIDTH must be 3 here"); end
      4:    begin : gen_4 $error("S_AXIS_TUSER_WIDTH must be 4 here"); end
      5:    begin : gen_5 $error("S_AXIS_TUSER_WIDTH must be 5 here"); end
      6:    begin : gen_6 $error("S_AXIS_TUSER_WIDTH must be 6 here"); end
      7:    begin : gen_7 $error("S_AXIS_TUSER_WIDTH must be 7 here"); end
      8:    begin : gen_8 $error("S_AXIS_TUSER_WIDTH must be 8 here"); end
      9:    begin : gen_9 $error("S_AXIS_TUSER_WIDTH must be 9 here"); end
      10:   begin : gen_10 $error("S_AXIS_TUSER_WIDTH must be 10 here"); end
      11:   begin : gen_11 $error("S_AXIS_TUSER_WIDTH must be 11 here"); end
      12:   begin : gen_12 $error("S_AXIS_TUSER_WIDTH must be 12 here"); end
      13:   begin : gen_13 $error("S_AXIS_TUSER_WIDTH must be 13 here"); end
      14:   begin : gen_14 $error("S_AXIS_TUSER_WIDTH must be 14 here"); end
      15:   begin : gen_15 $error("S_AXIS_TUSER_WIDTH must be 15 here"); end
      16:   begin : gen_16 $error("S_AXIS_TUSER_WIDTH must be 16 here"); end
      default: begin : gen_other $error("S_AXIS_TUSER_WIDTH is wrong"); end
    endcase
  end
`endif

endmodule
