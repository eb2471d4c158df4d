# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
#
# What vivado.tcl and quartus.tcl know of a release archive.

namespace eval openmb4 {
  # Each top and the room of its RTL; those of mb4 have presets, the others parameters.
  variable rooms {mb4_core mb4 mb4_axil mb4 mb4_wb mb4 biss_axi axi biss_spi axi biss_clb clb biss_pru pru dsl_axil dsl}
  variable presets {full drive single reader}

  # Unpacks openmb4-VERSION.tar.gz into a folder; returns the release's own folder there.
  proc unpack {archive folder} {
    file mkdir $folder
    exec tar -xzf $archive -C $folder
    set name [file rootname [file rootname [file tail $archive]]]
    set release [file normalize [file join $folder $name]]
    if {![file isdirectory [file join $release rtl]]} {
      error "$archive holds no $name/rtl: is it a release of openmb4?"
    }
    return $release
  }

  # The files that a list names, those of the lists it names included, in their order.
  proc listed {list} {
    set files {}
    set input [open $list]
    foreach line [split [read $input] "\n"] {
      set line [string trim $line]
      if {[string match "-F *" $line]} {
        lappend files {*}[listed [file join [file dirname $list] [string range $line 3 end]]]
      } elseif {$line ne "" && ![string match "//*" $line]} {
        lappend files [file normalize [file join [file dirname $list] $line]]
      }
    }
    close $input
    return $files
  }

  proc room {top} {
    variable rooms
    return [dict get $rooms $top]
  }

  proc rtl {release top} {
    set room [room $top]
    return [listed [file join $release rtl $room $room.f]]
  }

  # The word FEATURES of a preset, as a number.
  proc features {release preset} {
    set input [open [file join $release regmap mb4_page.rdl]]
    set text [read $input]
    close $input
    set name FEATURES_[string toupper $preset]
    if {![regexp "\"$name\", value: (0x\[0-9A-F\]+)" $text - value]} {
      error "$preset is no preset of this release"
    }
    return [expr {$value}]
  }

  # Names and values of the parameters that a preset stands for, or that NAME=VALUE,... says.
  proc parameters {release top values} {
    if {[room $top] eq "mb4"} {
      return [list Features [features $release $values]]
    }
    set found {}
    if {$values ne "default"} {
      foreach setting [split $values ,] {
        lappend found {*}[split $setting =]
      }
    }
    return $found
  }

  # The constraints of a top with a preset, or with any parameters; the file's name is TOP and this ending.
  proc constraints {release top values ending} {
    set folder [file join $release rtl [room $top] constraints]
    if {[room $top] eq "mb4" && $values ne "full"} {
      set folder [file join $folder $values]
    }
    return [file join $folder $top$ending]
  }

  # Stops at words that are no top, no preset and no parameters.
  proc check {top values} {
    variable rooms
    variable presets
    if {![dict exists $rooms $top]} {
      error "TOP is one of [dict keys $rooms]"
    }
    if {[room $top] eq "mb4"} {
      if {$values ni $presets} {
        error "PRESET is one of $presets"
      }
    } elseif {$values ne "default" && ![regexp {^\w+=[\w']+(,\w+=[\w']+)*$} $values]} {
      error "PARAMETERS are default, or NAME=VALUE,NAME=VALUE"
    }
  }
}
