











`include "enc_check.svh"

module mb4_spi_cmd #(
  parameter bit         ReadOnly   = 1'b0,
  parameter logic [7:0] Registers0 = mb4_regs_pkg_ADDR_SCDATA
) (
  input  logic       sclk_i,
  input  logic       frame_rst_ni,
  
  input  logic       byte_valid_i,
  input  logic [7:0] byte_i,
  output logic       tx_en_o,
  
  output mb4_pkg_host_t host_o
);

  typedef logic [2:0] state_e; localparam logic [2:0] OPCODE = 0, ADDR_WRITE = 1, ADDR_READ = 2, WRITE = 3, READ = 4, IGNORE = 5;

  state_e     state_d;
  state_e     state_q;
  logic [7:0] addr_d;
  logic [7:0] addr_q;
  logic [7:0] opcode;
  logic       wr_en, rd_en;
  logic [7:0] rd_addr;

  
  assign opcode = (ReadOnly && byte_i != mb4_regs_pkg_SPI_OPCODE_READ_REGISTERS &&
                   byte_i != mb4_regs_pkg_SPI_OPCODE_READ_REGISTERS0) ? 8'h00 : byte_i;

  logic [7:0] addr_d_shadow; logic [7:0] rd_addr_shadow; logic rd_en_shadow; state_e state_d_shadow; logic wr_en_shadow; always begin begin
    state_d_shadow   = state_q;
    addr_d_shadow    = addr_q;
    wr_en_shadow     = 1'b0;
    rd_en_shadow     = 1'b0;
    rd_addr_shadow   = addr_q;

    if (byte_valid_i) begin
      case (state_q)
        OPCODE: begin
          
          
          case (opcode)
            mb4_regs_pkg_SPI_OPCODE_WRITE_REGISTERS: state_d_shadow = ADDR_WRITE;
            mb4_regs_pkg_SPI_OPCODE_READ_REGISTERS:  state_d_shadow = ADDR_READ;
            mb4_regs_pkg_SPI_OPCODE_READ_STATUS: begin
              state_d_shadow   = READ;
              rd_en_shadow   = 1'b1;
              rd_addr_shadow = mb4_regs_pkg_ADDR_STATUS0;
            end
            mb4_regs_pkg_SPI_OPCODE_READ_REGISTERS0: begin
              state_d_shadow   = READ;
              rd_en_shadow   = 1'b1;
              rd_addr_shadow = Registers0;
            end
            mb4_regs_pkg_SPI_OPCODE_WRITE_INSTRUCTION: begin
              state_d_shadow = WRITE;
              addr_d_shadow  = mb4_regs_pkg_ADDR_INSTR;
            end
            mb4_regs_pkg_SPI_OPCODE_WRITE_REGISTERS0: begin
              state_d_shadow = WRITE;
              addr_d_shadow  = Registers0;
            end
            default: state_d_shadow = IGNORE;
          endcase
        end
        ADDR_WRITE: begin
          
          state_d_shadow = WRITE;
          addr_d_shadow  = byte_i;
        end
        ADDR_READ: begin
          
          
          state_d_shadow   = READ;
          rd_en_shadow   = 1'b1;
          rd_addr_shadow = byte_i;
        end
        WRITE: begin
          
          wr_en_shadow = 1'b1;
          addr_d_shadow  = addr_q + 8'd1;
        end
        READ: begin
          
          rd_en_shadow = 1'b1;
        end
        IGNORE: begin
          
        end
        default: state_d_shadow = IGNORE;
      endcase
      if (rd_en_shadow) addr_d_shadow = rd_addr_shadow + 8'd1;
    end
  end addr_d = addr_d_shadow; rd_addr = rd_addr_shadow; rd_en = rd_en_shadow; state_d = state_d_shadow; wr_en = wr_en_shadow; @(addr_q or byte_i or byte_valid_i or opcode or state_q); end

  always_ff @(posedge sclk_i or negedge frame_rst_ni) begin
    if (!frame_rst_ni) begin
      state_q <= OPCODE;
      addr_q  <= '0;
    end else begin
      state_q <= state_d;
      addr_q  <= addr_d;
    end
  end

  assign tx_en_o = state_q == READ;
  assign host_o  = {wr_en, addr_q, byte_i, rd_en, rd_addr};

  `ENC_ASSERT(StateInRange_A, sclk_i, frame_rst_ni, state_q <= IGNORE)
  `ENC_ASSERT(ReadOrWrite_A, sclk_i, frame_rst_ni, !(wr_en && rd_en))

endmodule
